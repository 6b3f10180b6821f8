// SPDX-License-Identifier: Apache-2.0
#include "calibration/arrowhead.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "support/landmark_position.hpp"

namespace geoloc {
namespace {

constexpr FlightPrior kFlight{0.7, 1.3, 0.3};
/// Height of the ground under all objects, and its 1-sigma.
constexpr double kGround_m = -0.8, kSigmaGround_m = 2.0;
constexpr double kWanderSigma_m = 0.4;
constexpr double kSwayVariance_m2 = 0.8, kTurnVariance_rad2 = 0.5;

PointInformation on_the_ground() {
  PointInformation ground;
  ground.matrix(2, 2) = 1.0 / (kSigmaGround_m * kSigmaGround_m);
  ground.vector.z() = kGround_m * ground.matrix(2, 2);
  return ground;
}

/// Random looks at random objects on the ground, over some drift nodes and spells of the sway, of which the
/// last are estimated.
class ArrowheadProblem : public ::testing::Test {
 protected:
  struct Look {
    std::size_t object;
    LandmarkObservation observation;
  };

  enum class Order { kByTurns, kOneAfterAnother };

  void make(std::size_t objects, int looks, double duration_s, Order order = Order::kByTurns) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    Landmark unseen;
    unseen.add_prior(on_the_ground());
    landmarks_.assign(objects, unseen);
    for (int i = 0; i < looks; ++i) {
      Look look;
      const auto number = static_cast<std::size_t>(i);
      look.object =
          order == Order::kByTurns ? number % objects : number * objects / static_cast<std::size_t>(looks);
      auto& o = look.observation;
      o.span = drift_.cover(VehicleTime{from_seconds(duration_s * i / looks)}, kWanderSigma_m);
      for (; spells_drawn_ < drift_.sway().end(); ++spells_drawn_)
        for (double& value : drift_.sway().spell(spells_drawn_).mean) value = normal(random);
      while (drift_.sway().is_full()) freeze_spell();
      for (double& value : o.calibration_jacobian.reshaped()) value = normal(random);
      for (double& value : o.node_jacobian.reshaped()) value = normal(random);
      o.slope = {normal(random), normal(random)};
      o.value = {10.0 * static_cast<double>(look.object) + normal(random), normal(random)};
      Eigen::Matrix2d root;
      for (double& value : root.reshaped()) value = normal(random);
      o.information = root * root.transpose() + Eigen::Matrix2d::Identity();
      looks_.push_back(look);
      if (!is_late(number)) landmarks_[look.object].add(o, drift_);
    }
    for (std::size_t i = 0; i < looks_.size(); ++i)
      if (is_late(i)) landmarks_[looks_[i].object].add(looks_[i].observation, drift_);
  }

  /// Those that are taken in after all others, most of them when their spell is frozen: linearised anew.
  static bool is_late(std::size_t look) { return look % 7 == 3; }

  /// As the tracker does.
  void freeze_spell() {
    for (Landmark& landmark : landmarks_) landmark.freeze_spell(drift_.sway().begin(), drift_);
    drift_.sway().freeze_oldest();
  }

  /// Leaves a node out, as the tracker does; looks and heights are told of the line that takes its place.
  void thin(const ThinnedNode& node) {
    while (drift_.sway().spell(drift_.sway().begin()).node <= node.number) freeze_spell();
    for (Landmark& landmark : landmarks_) landmark.thin(node, drift_);
    heights_.thin(node);
    drift_.thin(node);
    for (Look& look : looks_) {
      auto& o = look.observation;
      const double second = o.span.weight_of_second, w = node.weight_of_next;
      if (o.span.first == node.number) {
        o.value += (1.0 - second) * o.node_jacobian * node.deviation;
        o.span.weight_of_second = second + (1.0 - second) * w;
      } else if (o.span.first + 1 == node.number) {
        o.value += second * o.node_jacobian * node.deviation;
        o.span.weight_of_second = second * w;
      }
      if (o.span.first < node.number) ++o.span.first;
    }
  }

  std::vector<const Landmark*> all() const {
    std::vector<const Landmark*> pointers;
    for (const Landmark& landmark : landmarks_) pointers.push_back(&landmark);
    return pointers;
  }

  /// Solves and takes the solution over, as the estimate of shared errors does.
  ArrowheadSolver::Solution solve(ArrowheadSolver& solver, const std::vector<const Landmark*>& landmarks) {
    const auto solution = solver.solve(landmarks, kFlight, drift_, heights_);
    EXPECT_TRUE(solution);
    calibration_ = solution->calibration();
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      drift_.node(number).mean = solution->node(number);
    SwayTimeline& sway = drift_.sway();
    for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
      Spell& spell = sway.spell(number);
      spell.mean = solution->spell(number);
      spell.per_focal = solution->spell_per_focal(number);
      spell.focal = calibration_.mean[CalibrationIndex::kFocal];
    }
    return *solution;
  }
  ArrowheadSolver::Solution solve() { return solve(solver_, all()); }

  /// Covariance of a process at the nodes, where each is transition times the one before and an independent
  /// rest.
  template <typename Transition, typename Variance>
  Eigen::MatrixXd covariance_of_process(const Transition& transition, const Variance& variance) const {
    const Eigen::Index size = drift_.size();
    Eigen::MatrixXd from_rests = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd variances(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const DriftNode& node = drift_.node(drift_.begin() + static_cast<std::uint32_t>(k));
      if (k > 0) from_rests.row(k) = transition(node) * from_rests.row(k - 1);
      from_rests(k, k) = 1.0;
      variances[k] = variance(node);
    }
    return from_rests * variances.asDiagonal() * from_rests.transpose();
  }
  Eigen::MatrixXd wandering_covariance() const {
    return covariance_of_process(
        [](const DriftNode& node) { return node.transition[0]; },
        [&](const DriftNode& node) { return std::pow(drift_.position_scale(), 2) / node.information[0]; });
  }
  Eigen::MatrixXd ripple_covariance() const {
    return covariance_of_process(
        [](const DriftNode& node) { return node.ripple_transition; },
        [&](const DriftNode& node) { return std::pow(drift_.position_scale(), 2) * node.ripple_innovation; });
  }
  Eigen::VectorXd position_prior_mean(int axis) const {
    Eigen::VectorXd means(drift_.size());
    double mean = 0.0;
    for (Eigen::Index k = 0; k < means.size(); ++k) {
      const DriftNode& node = drift_.node(drift_.begin() + static_cast<std::uint32_t>(k));
      means[k] = mean = node.prior_mean[axis] + node.transition[axis] * mean;
    }
    return means;
  }

  /// The same problem as one dense least-squares system over objects, spells, calibration and nodes, solved
  /// by QR.
  struct Dense {
    Eigen::VectorXd solution;  // objects (3 each), spells, calibration, nodes
    Eigen::MatrixXd covariance;
    Eigen::Index spells;       // where they begin
    Eigen::Index calibration;  // where it begins
    Eigen::Index spell_column(std::uint32_t place) const {
      return spells + kSwaySize * static_cast<Eigen::Index>(place);
    }
    Eigen::Index node_column(std::uint32_t place) const {
      return calibration + CalibrationIndex::kSize + kNodeSize * static_cast<Eigen::Index>(place);
    }

    Point position(Eigen::Index object) const { return solution.segment<3>(3 * object); }
    CalibrationVector calibration_mean() const {
      return solution.segment<CalibrationIndex::kSize>(calibration);
    }
    CalibrationMatrix calibration_covariance() const {
      return covariance.block<CalibrationIndex::kSize, CalibrationIndex::kSize>(calibration, calibration);
    }

    /// Rows that pick an object, with the calibration's height taken from its own.
    Eigen::MatrixXd above_home(Eigen::Index object) const {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, solution.size());
      rows.middleCols<3>(3 * object).setIdentity();
      rows(2, calibration + CalibrationIndex::kHeight) = -1.0;
      return rows;
    }
    PointMatrix covariance_of(const Eigen::MatrixXd& rows) const {
      return rows * covariance * rows.transpose();
    }
  };
  Dense dense(const std::vector<std::size_t>& object_of) const {
    const auto objects = static_cast<Eigen::Index>(1 + *std::max_element(object_of.begin(), object_of.end()));
    const SwayTimeline& sway = drift_.sway();
    const Eigen::Index spells = 3 * objects, head = spells + kSwaySize * sway.size(), nodes = drift_.size();
    const Eigen::Index size = head + CalibrationIndex::kSize + kNodeSize * nodes;
    const auto node_column = [&](std::uint32_t number) {
      return head + CalibrationIndex::kSize + kNodeSize * static_cast<Eigen::Index>(number - drift_.begin());
    };
    const auto spell_column = [&](std::uint32_t number) {
      return spells + kSwaySize * static_cast<Eigen::Index>(number - sway.begin());
    };
    std::vector<Eigen::RowVectorXd> rows;
    std::vector<double> values;
    for (const Look& look : looks_) {
      const auto& o = look.observation;
      const Eigen::Matrix2d root = o.information.llt().matrixU();
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(2, size);
      const Eigen::Index object = 3 * static_cast<Eigen::Index>(object_of[look.object]);
      row.middleCols<2>(object).setIdentity();
      row.col(object + 2) = -o.slope;
      row.middleCols<CalibrationIndex::kSize>(head) = -o.calibration_jacobian;
      if (o.span.first >= drift_.begin())
        row.middleCols<kNodeSize>(node_column(o.span.first)) -=
            (1 - o.span.weight_of_second) * o.node_jacobian;
      row.middleCols<kNodeSize>(node_column(o.span.first + 1)) -= o.span.weight_of_second * o.node_jacobian;
      Eigen::Vector2d value = o.value;
      if (sway.is_frozen(o.span.spell)) {
        value += o.sway_jacobian() * sway.spell(o.span.spell).mean;
      } else {
        row.middleCols<kSwaySize>(spell_column(o.span.spell)) = -o.sway_jacobian();
      }
      row = root * row;
      value = root * value;
      for (int i = 0; i < 2; ++i) {
        rows.push_back(row.row(i));
        values.push_back(value[i]);
      }
    }
    for (Eigen::Index object = 0; object < objects; ++object) {
      rows.push_back(Eigen::RowVectorXd::Unit(size, 3 * object + 2) / kSigmaGround_m);
      values.push_back(kGround_m / kSigmaGround_m);
    }
    for (const HeightObservation& seen : heights_.observations()) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(size, head + CalibrationIndex::kHeight);
      row[node_column(seen.span.first) + 2] = 1.0 - seen.span.weight_of_second;
      row[node_column(seen.span.first + 1) + 2] = seen.span.weight_of_second;
      rows.push_back(std::sqrt(seen.information) * row);
      values.push_back(std::sqrt(seen.information) * seen.value_m);
    }
    const Calibration prior = solver_.prior(kFlight);
    for (int i = 0; i < CalibrationIndex::kSize; ++i) {
      rows.push_back(Eigen::RowVectorXd::Unit(size, head + i) / prior.sigma(i));
      values.push_back(prior.mean[i] / prior.sigma(i));
    }
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
      const DriftNode& node = drift_.node(number);
      for (int i = 2; i < kNodeSize; ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(size, node_column(number) + i);
        if (number != drift_.begin()) row[node_column(number - 1) + i] = -node.transition[i];
        const double root = std::sqrt(node.information[i]);
        rows.push_back(root * row);
        values.push_back(root * node.prior_mean[i]);
      }
    }
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::MatrixXd whitening = (wandering_covariance() + ripple_covariance())
                                            .llt()
                                            .matrixL()
                                            .solve(Eigen::MatrixXd::Identity(nodes, nodes));
      const Eigen::VectorXd means = whitening * position_prior_mean(axis);
      for (Eigen::Index i = 0; i < nodes; ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
        for (Eigen::Index j = 0; j < nodes; ++j)
          row[head + CalibrationIndex::kSize + kNodeSize * j + axis] = whitening(i, j);
        rows.push_back(row);
        values.push_back(means[i]);
      }
    }
    for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
      const Spell& spell = sway.spell(number);
      for (int i = 0; i < kSwaySize; ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(size, spell_column(number) + i);
        if (number != sway.begin()) row[spell_column(number - 1) + i] = -spell.transition;
        const double sigma =
            std::sqrt(spell.innovation_share * (i < 2 ? kSwayVariance_m2 : kTurnVariance_rad2));
        rows.push_back(row / sigma);
        values.push_back(spell.prior_mean[i] / sigma);
      }
    }
    Eigen::MatrixXd A(static_cast<Eigen::Index>(rows.size()), size);
    for (std::size_t i = 0; i < rows.size(); ++i) A.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Eigen::VectorXd b =
        Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    return {A.colPivHouseholderQr().solve(b), (A.transpose() * A).inverse(), spells, head};
  }

  void expect_head_of(const ArrowheadSolver::Solution& solution, const Dense& expected) const {
    EXPECT_LT((calibration_.mean - expected.calibration_mean()).norm(), 1e-8);
    EXPECT_LT((calibration_.covariance - expected.calibration_covariance()).norm(), 1e-8);
    EXPECT_LT(
        (solution.newest_node_covariance() - expected.covariance.bottomRightCorner<kNodeSize, kNodeSize>())
            .norm(),
        1e-8);
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
      const Eigen::Index column = expected.node_column(number - drift_.begin());
      EXPECT_LT((solution.node(number) - expected.solution.segment<kNodeSize>(column)).norm(), 1e-8);
    }
    const SwayTimeline& sway = drift_.sway();
    for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
      const Eigen::Index column = expected.spell_column(number - sway.begin());
      EXPECT_LT((solution.spell(number) - expected.solution.segment<kSwaySize>(column)).norm(), 1e-8);
    }
  }

  void expect_objects_of(const ArrowheadSolver::Solution& solution, const Dense& expected) const {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(landmarks_.size()); ++i) {
      const Landmark& landmark = landmarks_[static_cast<std::size_t>(i)];
      EXPECT_LT((position_of(landmark, calibration_.mean, drift_) - expected.position(i)).norm(), 1e-8);
      EXPECT_LT((solution.covariance(landmark) - expected.covariance_of(expected.above_home(i))).norm(),
                1e-8);
      for (Eigen::Index j = 0; j < i; ++j) {
        const PointMatrix difference =
            expected.covariance_of(expected.above_home(i) - expected.above_home(j));
        const Landmark& other = landmarks_[static_cast<std::size_t>(j)];
        EXPECT_LT((solution.covariance_of_difference(landmark, other) - difference).norm(), 1e-8);
      }
    }
  }

  void SetUp() override { drift_.sway().set_variance(kSwayVariance_m2, kTurnVariance_rad2); }

  static DriftConfig config() {
    DriftConfig config;
    config.node_spacing_s = 5.0;
    config.max_nodes = 36;
    return config;
  }

  static DriftConfig without_ripple() {
    DriftConfig still = config();
    still.ripple_share = 0.0;
    return still;
  }

  DriftTimeline drift_{config()};
  CalibrationPrior prior_;
  ArrowheadSolver solver_{prior_, config()};
  Calibration calibration_;
  HeightLog heights_{config().max_nodes};
  std::vector<Landmark> landmarks_;
  std::vector<Look> looks_;
  std::uint32_t spells_drawn_ = 0;
};

TEST_F(ArrowheadProblem, SolutionAndCovariancesAreThoseOfDenseLeastSquares) {
  make(5, 200, 40.0);
  ASSERT_EQ(drift_.sway().size(), config().max_spells);
  ASSERT_EQ(drift_.sway().begin(), 34U) << "the others are frozen";
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 3, 4});
  expect_head_of(solution, expected);
  expect_objects_of(solution, expected);
}

/// So short a flight that no spell is frozen yet; more variance of the sway than is known of anything else.
TEST_F(ArrowheadProblem, AllSpellsOfTheFirstSecondsAreThoseOfDenseLeastSquares) {
  make(3, 80, 6.0);
  ASSERT_EQ(drift_.sway().begin(), 0U);
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2});
  expect_head_of(solution, expected);
  expect_objects_of(solution, expected);
}

/// With none, it is as if it were not looked for.
TEST_F(ArrowheadProblem, ASwayOfNoVarianceStaysWhereItIsExpected) {
  drift_.sway().set_variance(0.0, 0.0);
  make(3, 80, 5.9);
  const ArrowheadSolver::Solution solution = solve();
  const SwayTimeline& sway = drift_.sway();
  for (std::uint32_t number = sway.begin(); number != sway.end(); ++number)
    EXPECT_LT(solution.spell(number).norm(), 1e-8);
}

/// Nodes that a line has taken the place of, the first of them next to those of the spells.
TEST_F(ArrowheadProblem, SolutionsAfterThinningAreThoseOfDenseLeastSquaresOnTheLine) {
  make(5, 300, 60.0);
  for (const double time_s : {2.0, 13.0, 18.0, 23.0, 59.0}) {
    const auto first = static_cast<std::uint32_t>(time_s / 5.0);
    heights_.add({first, time_s / 5.0 - first}, 0.4 + 0.01 * time_s, 0.3);
  }
  solve();
  for (const std::uint32_t number : {10U, 2U, 5U, 7U, 6U, 8U}) {
    const NodeVector deviation = NodeVector::LinSpaced(0.3, -0.1 * number);
    thin({number, 0.2 + 0.05 * number, deviation});
    const ArrowheadSolver::Solution solution = solve();
    const Dense expected = dense({0, 1, 2, 3, 4});
    expect_head_of(solution, expected);
    expect_objects_of(solution, expected);
  }
  EXPECT_EQ(drift_.size(), 7);
}

/// As on a flight, each object is seen at a few nodes only: none before those concerns it.
TEST_F(ArrowheadProblem, HeightsSeenBesidesAreRowsOfDenseLeastSquares) {
  make(5, 200, 40.0);
  const double begin_s = seconds(drift_.node(drift_.begin()).time.time_since_epoch());
  for (const double time_s : {2.0, 13.0, 13.5, 39.0}) {
    std::uint32_t first = drift_.begin();
    while (begin_s + 5.0 * (first + 1) < time_s) ++first;
    heights_.add({first, time_s / 5.0 - first}, 0.4 + 0.01 * time_s, 0.3);
  }
  ASSERT_EQ(heights_.observations().size(), 3U);
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 3, 4});
  EXPECT_LT((calibration_.mean - expected.calibration_mean()).norm(), 1e-8);
  EXPECT_LT((calibration_.covariance - expected.calibration_covariance()).norm(), 1e-8);
  expect_objects_of(solution, expected);
}

TEST_F(ArrowheadProblem, ObjectsSeenOneAfterAnotherAreThoseOfDenseLeastSquares) {
  make(5, 400, 170.0, Order::kOneAfterAnother);
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 3, 4});
  expect_head_of(solution, expected);
  expect_objects_of(solution, expected);
}

TEST_F(ArrowheadProblem, MergingSumsIsHavingSeenOneObject) {
  make(4, 160, 30.0);
  landmarks_[1].merge(landmarks_[3], drift_);
  landmarks_[1].add_prior(-on_the_ground());
  landmarks_.pop_back();
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 1});
  EXPECT_LT((calibration_.mean - expected.calibration_mean()).norm(), 1e-8);
  EXPECT_LT((position_of(landmarks_[1], calibration_.mean, drift_) - expected.position(1)).norm(), 1e-8);
  EXPECT_LT((solution.covariance(landmarks_[1]) - expected.covariance_of(expected.above_home(1))).norm(),
            1e-8);
}

TEST_F(ArrowheadProblem, LeavingAnObjectOutIsNeverHavingSeenIt) {
  make(3, 90, 20.0);
  landmarks_.pop_back();
  solve();
  looks_.erase(
      std::remove_if(looks_.begin(), looks_.end(), [](const Look& look) { return look.object == 2; }),
      looks_.end());
  const Dense expected = dense({0, 1});
  EXPECT_LT((calibration_.mean - expected.calibration_mean()).norm(), 1e-8);
}

TEST_F(ArrowheadProblem, OneLookAtAnObjectSaysNothingOfTheCalibration) {
  make(6, 6, 2.0);
  solve();
  const Calibration prior = solver_.prior(kFlight);
  EXPECT_LT((calibration_.mean - prior.mean).norm(), 1e-9);
  for (int i = 0; i < CalibrationIndex::kSize; ++i) EXPECT_NEAR(calibration_.sigma(i), prior.sigma(i), 1e-6);
}

TEST_F(ArrowheadProblem, AFrozenComponentStaysWhereItIs) {
  CalibrationPrior prior;
  prior.latency_s = 0.123;
  prior.sigma_latency_s = 0.0;
  make(4, 100, 20.0);
  ArrowheadSolver frozen(prior, config());
  solve(frozen, all());
  EXPECT_NEAR(calibration_.latency_s(), 0.123, 1e-6);
  EXPECT_LT(calibration_.sigma(CalibrationIndex::kLatency), 1e-6);
}

/// Where nothing ripples: what of a frozen node was ripple is not kept.
TEST_F(ArrowheadProblem, FreezingANodeAtItsEstimateChangesNoEstimate) {
  drift_ = DriftTimeline(without_ripple());
  drift_.sway().set_variance(kSwayVariance_m2, kTurnVariance_rad2);
  make(4, 160, 40.0);
  solve();
  const CalibrationVector before = calibration_.mean;
  const Point position = position_of(landmarks_[2], calibration_.mean, drift_);
  for (Landmark& landmark : landmarks_) landmark.freeze(drift_.begin(), drift_);
  drift_.freeze_oldest();
  solve();
  EXPECT_LT((calibration_.mean - before).norm(), 1e-8);
  EXPECT_LT((position_of(landmarks_[2], calibration_.mean, drift_) - position).norm(), 1e-8);
}

/// Spells one by one, then nodes that spells are tied to; and what is learnt then is what it was. Nothing
/// ripples.
TEST_F(ArrowheadProblem, FreezingASpellAtItsEstimateChangesNoEstimate) {
  for (const double duration_s : {40.0, 3.9}) {
    drift_ = DriftTimeline(without_ripple());
    drift_.sway().set_variance(kSwayVariance_m2, kTurnVariance_rad2);
    spells_drawn_ = 0;
    looks_.clear();
    make(4, 160, duration_s);
    solve();
    const CalibrationVector before = calibration_.mean;
    const Point position = position_of(landmarks_[2], calibration_.mean, drift_);
    const NodeVector newest = drift_.node(drift_.end() - 1).mean;
    const SwayVector sway = drift_.sway().spell(drift_.sway().end() - 1).mean;
    while (drift_.sway().size() > 1) {
      freeze_spell();
      if (drift_.sway().size() == 2) {
        for (Landmark& landmark : landmarks_) landmark.freeze(drift_.begin(), drift_);
        drift_.freeze_oldest();
      }
      solve();
      EXPECT_LT((calibration_.mean - before).norm(), 1e-8);
      EXPECT_LT((position_of(landmarks_[2], calibration_.mean, drift_) - position).norm(), 1e-8);
      EXPECT_LT((drift_.node(drift_.end() - 1).mean - newest).norm(), 1e-8);
      EXPECT_LT((drift_.sway().spell(drift_.sway().end() - 1).mean - sway).norm(), 1e-8);
    }
  }
}

/// Held at its estimate alone, it would vouch for the focal length that this belongs to.
TEST_F(ArrowheadProblem, AFrozenSpellSaysNoMoreOfTheFocalLengthThanBefore) {
  CalibrationPrior prior;
  prior.sigma_focal_percent = 50.0;
  ArrowheadSolver solver(prior, config());
  make(4, 160, 5.9);
  solve(solver, all());
  const Calibration before = calibration_;
  while (drift_.sway().size() > 1) {
    freeze_spell();
    solve(solver, all());
    EXPECT_LT((calibration_.mean - before.mean).norm(), 1e-8);
    EXPECT_NEAR(calibration_.sigma(CalibrationIndex::kFocal), before.sigma(CalibrationIndex::kFocal), 1e-8);
  }
}

/// Spells that have lost a node, or both.
TEST_F(ArrowheadProblem, FrozenNodesAndSpellsAreThoseOfDenseLeastSquares) {
  make(4, 160, 8.9);
  solve();
  for (Look& look : looks_) {  // of nodes that are frozen next: what is left of their terms is a value
    auto& o = look.observation;
    if (o.span.first != drift_.begin()) continue;
    o.value += (1.0 - o.span.weight_of_second) * o.node_jacobian * drift_.node(drift_.begin()).mean;
  }
  for (Landmark& landmark : landmarks_) landmark.freeze(drift_.begin(), drift_);
  drift_.freeze_oldest();
  freeze_spell();
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 3});
  expect_head_of(solution, expected);
  expect_objects_of(solution, expected);
}

/// By its definition from the dense solution: the mean square of what the nodes differ by from what those
/// before let expect, in units of the prior's.
TEST_F(ArrowheadProblem, ObservedWanderingIsTheExpectedSquareOfTheSteps) {
  make(5, 300, 44.0);
  drift_.set_position_scale(0.7);
  const ArrowheadSolver::Solution solution = solve();
  const Dense expected = dense({0, 1, 2, 3, 4});
  const Eigen::Index nodes = drift_.size();
  const Eigen::MatrixXd covariance = wandering_covariance() + ripple_covariance();
  double sum = 0.0;
  for (Eigen::Index i = 1; i < nodes; ++i) {
    // Given the nodes before, node i is expected at `weights` times them, with the variance `rest`.
    const Eigen::VectorXd cross = covariance.col(i).head(i);
    const Eigen::VectorXd weights = covariance.topLeftCorner(i, i).ldlt().solve(cross);
    const double rest = covariance(i, i) - cross.dot(weights);
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(expected.solution.size());
      for (Eigen::Index j = 0; j <= i; ++j)
        step[expected.node_column(static_cast<std::uint32_t>(j)) + axis] = j == i ? 1.0 : -weights[j];
      const double mean = step.dot(expected.solution), variance = step.dot(expected.covariance * step);
      sum += (mean * mean + variance) / rest;
    }
  }
  const auto observed = solution.observed_wandering(drift_);
  ASSERT_TRUE(observed);
  EXPECT_NEAR(*observed, 0.7 * std::sqrt(sum / (2.0 * static_cast<double>(nodes - 1))), 1e-8);
}

TEST_F(ArrowheadProblem, ObservedWanderingNeedsEightNodes) {
  make(2, 30, 29.0);  // 7 nodes, five seconds apart
  ASSERT_EQ(drift_.size(), 7);
  EXPECT_FALSE(solve().observed_wandering(drift_));
  drift_.cover(VehicleTime{from_seconds(31.0)}, kWanderSigma_m);
  EXPECT_TRUE(solve().observed_wandering(drift_));
}

/// Looks from a vehicle whose position wanders and ripples by Gauss-Markov processes of known strength, two
/// objects in view at any time and each for a minute.
TEST(ObservedWandering, ConvergesOnTheStrengthOfASimulatedProcess) {
  constexpr int kNodes = 150, kNodesInView = 12;
  constexpr double kNoise_m = 0.02;
  DriftConfig config;
  config.node_spacing_s = 5.0;
  config.max_nodes = kNodes;
  config.max_spells = 0;  // nothing sways
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto drawn = [&] { return Eigen::Vector2d(normal(random), normal(random)); };
  for (const double strength : {0.3, 1.0, 2.5}) {
    DriftTimeline drift(config);
    drift.cover(VehicleTime{}, kWanderSigma_m);  // the first node is at 0
    Landmark unseen;
    unseen.add_prior(on_the_ground());
    std::vector<Landmark> landmarks(2 + 2 * kNodes / kNodesInView, unseen);
    const double sigma_m = strength * std::sqrt(1.0 - config.ripple_share) * kWanderSigma_m;
    const double ripple_m = strength * std::sqrt(config.ripple_share) * kWanderSigma_m;
    const double kept = std::exp(-config.node_spacing_s / config.position_time_constant_s);
    const double ripple_kept = std::exp(-config.node_spacing_s / config.ripple_time_constant_s);
    Eigen::Vector2d wandering = sigma_m * drawn(), ripple = ripple_m * drawn(), before = wandering + ripple;
    for (int node = 0; node + 1 < kNodes; ++node) {
      wandering = kept * wandering + sigma_m * std::sqrt(1.0 - kept * kept) * drawn();
      ripple = ripple_kept * ripple + ripple_m * std::sqrt(1.0 - ripple_kept * ripple_kept) * drawn();
      const Eigen::Vector2d after = wandering + ripple;
      for (int i = 0; i < 10; ++i) {
        LandmarkObservation look;
        const double time_s = config.node_spacing_s * (node + 0.05 + 0.1 * i);
        look.span = drift.cover(VehicleTime{from_seconds(time_s)}, kWanderSigma_m);
        const double weight = look.span.weight_of_second;
        look.value = kNoise_m * drawn() - (1.0 - weight) * before - weight * after;
        look.slope.setZero();
        look.calibration_jacobian.setZero();
        look.calibration_jacobian.rightCols<2>().setIdentity();
        look.node_jacobian.setZero();
        look.node_jacobian.leftCols<2>().setIdentity();
        look.information = Eigen::Matrix2d::Identity() / (kNoise_m * kNoise_m);
        const int half = kNodesInView / 2;  // every other object comes into view half a minute later
        const int object = i % 2 == 0 ? 2 * (node / kNodesInView) : 2 * ((node + half) / kNodesInView) + 1;
        landmarks[static_cast<std::size_t>(object)].add(look, drift);
      }
      before = after;
    }
    std::vector<const Landmark*> seen;
    for (const Landmark& landmark : landmarks) {
      if (landmark.A()(0, 0) > 0.0) seen.push_back(&landmark);
    }
    ArrowheadSolver solver(CalibrationPrior{}, config);
    for (int round = 0; round < 10; ++round) {
      const auto solution = solver.solve(seen, kFlight, drift);
      ASSERT_TRUE(solution);
      for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
        drift.node(number).mean = solution->node(number);
      drift.set_position_scale(*solution->observed_wandering(drift));
    }
    // 149 steps on two axes: 4 % of sampling error.
    EXPECT_NEAR(drift.position_scale(), strength, 0.12 * strength);
  }
}

TEST_F(ArrowheadProblem, AnObjectKnownFromASurveyAloneHasThatCovariance) {
  make(2, 40, 12.0);
  Landmark surveyed;
  const PointMatrix covariance =
      (PointMatrix() << 0.04, 0.01, 0.0, 0.01, 0.09, 0.02, 0.0, 0.02, 0.16).finished();
  const Point position(3.0, 4.0, 0.5);
  surveyed.add_prior({covariance.inverse(), covariance.inverse() * position});
  const std::vector<const Landmark*> landmarks{&landmarks_[0], &landmarks_[1], &surveyed};
  const ArrowheadSolver::Solution solution = solve(solver_, landmarks);
  // Its height above home is known as well as the camera's is.
  const double height_of_home = std::pow(calibration_.sigma(CalibrationIndex::kHeight), 2);
  const PointMatrix above_home = Point(0.0, 0.0, height_of_home).asDiagonal().toDenseMatrix() + covariance;
  EXPECT_LT((solution.covariance(surveyed) - above_home).norm(), 1e-12);
  EXPECT_LT((position_of(surveyed, calibration_.mean, drift_) - position).norm(), 1e-12);
  const Dense expected = dense({0, 1});
  const Eigen::MatrixXd first = expected.above_home(0);
  Eigen::MatrixXd level = first;
  level(2, expected.calibration + CalibrationIndex::kHeight) = 0.0;
  const PointMatrix difference = covariance + expected.covariance_of(level);
  EXPECT_LT((solution.covariance_of_difference(surveyed, landmarks_[0]) - difference).norm(), 1e-9);
}

TEST_F(ArrowheadProblem, WhatIsNoNumberHasNoSolution) {
  make(2, 40, 12.0);
  Landmark broken;
  broken.add_prior({PointMatrix::Constant(std::nan("")), Point::Zero()});
  EXPECT_FALSE(solver_.solve({&landmarks_[0], &broken}, kFlight, drift_));
}

/// The head's height is what the flight's prior says it is, whatever the prior of the camera said.
TEST_F(ArrowheadProblem, AHeightThatIsKnownStaysWhereItIs) {
  make(4, 100, 20.0);
  const auto solution = solver_.solve(all(), {12.5, 0.0, 0.3}, drift_);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->calibration().height_m(), 12.5, 1e-6);
  EXPECT_LT(solution->calibration().sigma(CalibrationIndex::kHeight), 1e-6);
}

TEST(ArrowheadSolver, StatesThePriorInRadiansMetresAndSeconds) {
  CalibrationPrior prior;
  prior.boresight_x_deg = 1.0;
  prior.boresight_y_deg = -2.0;
  prior.boresight_z_deg = 3.0;
  prior.latency_s = 0.1;
  prior.sigma_boresight_x_deg = 4.0;
  prior.sigma_boresight_y_deg = 5.0;
  prior.sigma_boresight_z_deg = 0.0;
  prior.sigma_latency_s = 0.2;
  prior.position_lag_s = -0.02;
  prior.sigma_position_lag_s = 0.03;
  const ArrowheadSolver solver(prior, DriftConfig{});
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  CalibrationVector mean, sigma;
  mean << kDegree, -2.0 * kDegree, 3.0 * kDegree, 0.1, -0.4, 0.0, -0.02, 0.0, 0.0;
  sigma << 4.0 * kDegree, 5.0 * kDegree, 0.0, 0.2, 0.6, 0.0, 0.03, 0.7, 0.7;
  const Calibration stated = solver.prior({-0.4, 0.6, 0.7});
  EXPECT_LT((stated.mean - mean).norm(), 1e-12);
  for (int i = 0; i < CalibrationIndex::kSize; ++i) {
    EXPECT_NEAR(stated.sigma(i), sigma[i], 1e-8);
    EXPECT_GT(stated.sigma(i), 0.0);  // its inverse is finite
  }
}

}  // namespace
}  // namespace geoloc
