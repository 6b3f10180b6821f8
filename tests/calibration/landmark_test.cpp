// SPDX-License-Identifier: Apache-2.0
#include "calibration/landmark.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "support/landmark_position.hpp"

namespace geoloc {
namespace {

/// A landmark beside the list of everything it was told: the list is what its sums must be equal to.
class LandmarkSums : public ::testing::Test {
 protected:
  using NodeRow = Eigen::Matrix<double, 2, kNodeSize>;

  struct Prior {
    Point position;
    PointMatrix information;
  };

  struct Told {
    Landmark landmark;
    std::vector<LandmarkObservation> looks;
    std::vector<Prior> priors;
  };

  double draw() { return normal_(random_); }

  template <class Matrix>
  Matrix drawn() {
    return Matrix::NullaryExpr([this] { return draw(); });
  }

  template <class Matrix>
  Matrix drawn_information() {
    const Matrix root = drawn<Matrix>();
    return root * root.transpose() + 0.1 * Matrix::Identity();
  }

  static DriftConfig config() {
    DriftConfig config;
    config.node_spacing_s = 5.0;
    config.max_nodes = 60;  // none is overwritten
    return config;
  }

  void look(Told& told, double time_s) {
    if (std::find(looked_.begin(), looked_.end(), &told) == looked_.end()) looked_.push_back(&told);
    LandmarkObservation look;
    look.value = Eigen::Vector2d(5.0, -3.0) + drawn<Eigen::Vector2d>();
    look.slope = drawn<Eigen::Vector2d>();
    look.calibration_jacobian = drawn<Eigen::Matrix<double, 2, CalibrationIndex::kSize>>();
    look.node_jacobian = drawn<NodeRow>();
    look.information = drawn_information<Eigen::Matrix2d>();
    look.span = drift_.cover(VehicleTime{from_seconds(time_s)}, 0.5);
    for (const std::uint32_t number : {look.span.first, look.span.first + 1}) {
      if (known_up_to_ > number) continue;
      drift_.node(number).mean = drawn<NodeVector>();
      known_up_to_ = number + 1;
    }
    for (; spells_known_up_to_ < drift_.sway().end(); ++spells_known_up_to_)
      drift_.sway().spell(spells_known_up_to_).mean = drawn<SwayVector>();
    while (bounds_spells_ && drift_.sway().is_full()) freeze_spell();
    told.looks.push_back(look);
    told.landmark.add(look, drift_);
  }

  /// The oldest, for all that were looked at, as the tracker does.
  void freeze_spell() {
    SwayTimeline& sway = drift_.sway();
    frozen_spells_[sway.begin()] = sway.spell(sway.begin()).mean;
    for (Told* told : looked_) told->landmark.freeze_spell(sway.begin(), drift_);
    sway.freeze_oldest();
  }

  void look_many(Told& told, double begin_s, double end_s, int looks) {
    for (int i = 0; i < looks; ++i) look(told, begin_s + (end_s - begin_s) * i / looks);
  }

  void prior(Told& told, const Point& position, const PointMatrix& information) {
    told.priors.push_back({position, information});
    told.landmark.add_prior({information, information * position});
  }
  void prior(Told& told, const Point& position) { prior(told, position, drawn_information<PointMatrix>()); }

  /// Nothing but the height is known, in part.
  void ground(Told& told) { prior(told, {0.0, 0.0, -1.5}, Point(0.0, 0.0, 0.25).asDiagonal()); }

  using Nodes = std::map<std::uint32_t, NodeVector>;

  using Spells = std::map<std::uint32_t, SwayVector>;

  /// What looks depend on besides the object.
  struct Head {
    CalibrationVector calibration;
    Nodes nodes;
    Spells spells;
  };

  /// Any calibration, drift and sway, but for what is frozen.
  Head drawn_head() {
    Head head{drawn<CalibrationVector>(), drawn_nodes(), frozen_spells_};
    for (std::uint32_t number = 0; number != drift_.sway().end(); ++number) {
      const auto sway = drawn<SwayVector>();
      head.spells.emplace(number, sway);  // where it is not frozen
    }
    return head;
  }

  Nodes drawn_nodes() {
    Nodes nodes;
    for (std::uint32_t number = 0; number != drift_.end(); ++number) nodes[number] = drawn<NodeVector>();
    return nodes;
  }

  /// A point that is higher by one appears moved by the slope against it.
  static Eigen::Vector2d shown(const LandmarkObservation& look, const Point& x) {
    return {x[0] - look.slope[0] * x[2], x[1] - look.slope[1] * x[2]};
  }

  /// Where a look shows the object, with all errors taken out: east and north of the sway as they are, its
  /// turns as the camera's.
  static Eigen::Vector2d corrected(const LandmarkObservation& look, const Head& head) {
    const double second = look.span.weight_of_second;
    Eigen::Vector2d value = look.value + look.calibration_jacobian * head.calibration +
                            look.node_jacobian * ((1.0 - second) * head.nodes.at(look.span.first) +
                                                  second * head.nodes.at(look.span.first + 1));
    if (look.span.spell == kNoSpell) return value;
    const SwayVector& sway = head.spells.at(look.span.spell);
    value += sway.head<2>();
    value += look.calibration_jacobian.col(CalibrationIndex::kBoresight) * sway[2];
    value += look.calibration_jacobian.col(CalibrationIndex::kBoresight + 1) * sway[3];
    return value;
  }

  /// Sum of the squared residuals, look by look: by the definition of a look.
  static double cost(const Told& told, const Point& x, const Head& head) {
    double sum = 0.0;
    for (const LandmarkObservation& look : told.looks) {
      const Eigen::Vector2d residual = corrected(look, head) - shown(look, x);
      sum += residual.dot(look.information * residual);
    }
    for (const Prior& prior : told.priors)
      sum += (prior.position - x).dot(prior.information * (prior.position - x));
    return sum;
  }

  /// The same from the sums, but for a constant.
  static double cost(const Landmark& sums, const Point& x, const Head& head) {
    const CalibrationVector& c = head.calibration;
    Point linear = sums.b() + sums.B() * c;
    double cost = c.dot(sums.C() * c) - 2.0 * sums.g().dot(c);
    for (const Landmark::NodeTerms& terms : sums) {
      const NodeVector& d = head.nodes.at(terms.number);
      linear += terms.B * d;
      cost += d.dot(terms.C_own * d) + 2.0 * c.dot(terms.C_calibration * d) - 2.0 * terms.g.dot(d);
      const auto next = head.nodes.find(terms.number + 1);
      if (next != head.nodes.end()) cost += 2.0 * d.dot(terms.C_next * next->second);
    }
    for (const Landmark::SpellTerms& terms : sums.spells()) {
      const SwayVector& s = head.spells.at(terms.number);
      linear += terms.B * s;
      cost += s.dot(terms.C_own * s) + 2.0 * c.dot(terms.C_calibration * s) - 2.0 * terms.g.dot(s);
      for (std::uint32_t side = 0; side < 2; ++side)
        cost += 2.0 * head.nodes.at(terms.node + side).dot(terms.C_node[side] * s);
    }
    return cost + x.dot(sums.A() * x) - 2.0 * x.dot(linear);
  }

  /// Values of all nodes before one was left out, of those that remain: it is where the line between its
  /// neighbours and the deviation put it.
  static Nodes before_thinning(const Nodes& after, const ThinnedNode& thinned) {
    Nodes before;
    for (const auto& [number, value] : after) {
      if (number > thinned.number) before[number] = value;
      if (number <= thinned.number && number > 0) before[number - 1] = value;
    }
    const double w = thinned.weight_of_next;
    before[thinned.number] =
        (1.0 - w) * before.at(thinned.number - 1) + w * before.at(thinned.number + 1) + thinned.deviation;
    return before;
  }

  /// Both agree on how much worse any state is than another. `frozen`: nodes whose value is not asked for.
  /// `thinned`: left out since the looks, in this order.
  void expect_same_costs(const Told& told, const Nodes& frozen = {},
                         const std::vector<ThinnedNode>& thinned = {}) {
    double offset = 0.0;
    for (int trial = 0; trial < 10; ++trial) {
      const Point x = 3.0 * drawn<Point>();
      Head head = drawn_head();
      for (const auto& [number, value] : frozen) head.nodes[number] = value;
      Head head_of_looks = head;
      for (auto node = thinned.rbegin(); node != thinned.rend(); ++node)
        head_of_looks.nodes = before_thinning(head_of_looks.nodes, *node);
      const double expected = cost(told, x, head_of_looks);
      const double difference = expected - cost(told.landmark, x, head);
      if (trial == 0) offset = difference;
      EXPECT_NEAR(difference, offset, 1e-9 * (1.0 + expected));
    }
  }

  /// Weighted least squares over all looks with everything else known, by QR.
  static Point best_position(const Told& told, const Head& head) {
    const auto size = static_cast<Eigen::Index>(2 * told.looks.size() + 3 * told.priors.size());
    Eigen::MatrixXd rows(size, 3);
    Eigen::VectorXd values(size);
    Eigen::Index at = 0;
    const auto add = [&](const Eigen::MatrixXd& information, const Eigen::MatrixXd& by_point,
                         const Eigen::VectorXd& value) {
      const Eigen::MatrixXd root = information.llt().matrixU();
      rows.middleRows(at, value.size()) = root * by_point;
      values.segment(at, value.size()) = root * value;
      at += value.size();
    };
    for (const LandmarkObservation& look : told.looks) {
      Eigen::MatrixXd by_point(2, 3);
      by_point << 1.0, 0.0, -look.slope[0], 0.0, 1.0, -look.slope[1];
      add(look.information, by_point, corrected(look, head));
    }
    for (const Prior& prior : told.priors) add(prior.information, PointMatrix::Identity(), prior.position);
    return rows.colPivHouseholderQr().solve(values);
  }

  Nodes means() const {
    Nodes nodes;
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      nodes[number] = drift_.node(number).mean;
    return nodes;
  }

  /// As estimated.
  Head head_with(const CalibrationVector& calibration) const {
    Head head{calibration, means(), {}};
    for (std::uint32_t number = 0; number != drift_.sway().end(); ++number)
      head.spells[number] = drift_.sway().spell(number).mean;
    return head;
  }

  /// Numbers of the nodes, or spells, that the landmark is tied to.
  static std::vector<std::uint32_t> nodes_of(const Told& told) {
    std::vector<std::uint32_t> numbers;
    for (const Landmark::NodeTerms& terms : told.landmark) numbers.push_back(terms.number);
    return numbers;
  }
  static std::vector<std::uint32_t> spells_of(const Told& told) {
    std::vector<std::uint32_t> numbers;
    for (const Landmark::SpellTerms& terms : told.landmark.spells()) numbers.push_back(terms.number);
    return numbers;
  }
  using Numbers = std::vector<std::uint32_t>;

  DriftTimeline drift_{config()};
  Spells frozen_spells_;
  bool bounds_spells_ = true;  ///< as many as the drift's configuration says are estimated

 private:
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
  std::uint32_t known_up_to_ = 0;
  std::uint32_t spells_known_up_to_ = 0;
  std::vector<Told*> looked_;
};

TEST_F(LandmarkSums, SayWhatTheLooksSay) {
  Told told;
  look_many(told, 0.0, 42.0, 50);
  expect_same_costs(told);
}

TEST_F(LandmarkSums, SayWhatLooksAfterAPauseSay) {
  Told told;
  look_many(told, 0.0, 12.0, 10);
  look_many(told, 300.0, 312.0, 10);
  expect_same_costs(told);
}

TEST_F(LandmarkSums, SayWhatASurveySays) {
  Told told;
  prior(told, {5.2, -2.9, 0.4});
  expect_same_costs(told);
  look_many(told, 0.0, 12.0, 10);
  prior(told, {4.8, -3.1, -0.7});
  expect_same_costs(told);
}

/// What was added twice is taken out once: two landmarks on one ground become one that stands on it once.
TEST_F(LandmarkSums, AreRidOfAPriorByItsOpposite) {
  Told one, other;
  look_many(one, 0.0, 12.0, 10);
  look_many(other, 8.0, 26.0, 12);
  ground(one);
  ground(other);
  Told both = one;
  both.looks.insert(both.looks.end(), other.looks.begin(), other.looks.end());
  both.landmark.merge(other.landmark, drift_);
  const Prior& ground = both.priors.back();
  both.landmark.add_prior(-PointInformation{ground.information, ground.information * ground.position});
  expect_same_costs(both);
}

/// From one side alone, only the ground tells how high the object is, and so how far.
TEST_F(LandmarkSums, OfOneLookOnTheGroundGiveThePlaceWhereItsRayMeetsTheGround) {
  Told told;
  look(told, 1.0);
  ground(told);
  const LandmarkObservation& look = told.looks.front();
  const CalibrationVector calibration = drawn<CalibrationVector>();
  const Eigen::Vector2d level = corrected(look, head_with(calibration));
  const Point position = position_of(told.landmark, calibration, drift_);
  EXPECT_NEAR(position.z(), -1.5, 1e-9);
  EXPECT_LT((position.head<2>() - (level - 1.5 * look.slope)).norm(), 1e-9);
}

TEST_F(LandmarkSums, OfTwoLandmarksSayWhatTheLooksOfBothSay) {
  Told one, other;
  look_many(one, 0.0, 12.0, 10);
  look_many(other, 8.0, 26.0, 12);
  look_many(one, 22.0, 38.0, 10);
  prior(other, {5.0, -3.0, 1.0});
  Told both = one;
  both.looks.insert(both.looks.end(), other.looks.begin(), other.looks.end());
  both.priors = other.priors;
  both.landmark.merge(other.landmark, drift_);
  expect_same_costs(both);
  both = other;
  both.looks.insert(both.looks.end(), one.looks.begin(), one.looks.end());
  both.landmark.merge(one.landmark, drift_);
  expect_same_costs(both);
}

TEST_F(LandmarkSums, OfAFrozenNodeSayWhatTheLooksSayAtItsEstimate) {
  Told told;
  look_many(told, 0.0, 31.0, 40);
  Nodes frozen;
  for (const std::uint32_t node : {0U, 1U, 2U}) {
    frozen[node] = drift_.node(node).mean;
    told.landmark.freeze(node, drift_);
    ASSERT_EQ(told.landmark.begin()->number, node + 1);
    expect_same_costs(told, frozen);
  }
}

TEST_F(LandmarkSums, OfAFrozenLatencySayWhatTheyDidAtThatLatencyWhateverItBecomes) {
  Told told;
  look_many(told, 0.0, 20.0, 15);
  CalibrationVector calibration = drawn<CalibrationVector>();
  const Point before = position_of(told.landmark, calibration, drift_);
  told.landmark.freeze_latency(calibration[CalibrationIndex::kLatency]);
  calibration[CalibrationIndex::kLatency] += 7.0;
  EXPECT_LT((position_of(told.landmark, calibration, drift_) - before).norm(), 1e-9);
}

TEST_F(LandmarkSums, AreNotConcernedByANodeThatNoLookTouched) {
  Told told;
  look_many(told, 0.0, 4.0, 3);
  look_many(told, 300.0, 304.0, 3);
  told.landmark.freeze(7, drift_);
  expect_same_costs(told);
  Told untouched;
  untouched.landmark.freeze(0, drift_);
  EXPECT_EQ(untouched.landmark.begin(), untouched.landmark.end());
}

TEST_F(LandmarkSums, FreezeTheOldestNodesWhereThereAreTooMany) {
  Told told;
  constexpr int kNodes = static_cast<int>(Landmark::kMaxNodes) + 5;  // five seconds apart
  look_many(told, 0.0, 5.0 * (kNodes - 2) + 2.0, 6 * kNodes);
  Nodes frozen = means();
  ASSERT_EQ(told.landmark.end() - told.landmark.begin(), static_cast<std::ptrdiff_t>(Landmark::kMaxNodes));
  frozen.erase(frozen.find(told.landmark.begin()->number), frozen.end());
  ASSERT_EQ(frozen.size(), 5U);
  expect_same_costs(told, frozen);
}

TEST_F(LandmarkSums, KeepTheirNodesInOrder) {
  Told one, other;
  look_many(one, 0.0, 4.0, 3);
  look_many(other, 10.0, 24.0, 6);
  look_many(one, 30.0, 34.0, 3);
  one.landmark.merge(other.landmark, drift_);
  for (const auto* terms = one.landmark.begin(); terms + 1 < one.landmark.end(); ++terms)
    EXPECT_LT(terms->number, (terms + 1)->number);
  EXPECT_EQ(one.landmark.end() - one.landmark.begin(), 8);
}

TEST_F(LandmarkSums, GiveThePositionOfDenseLeastSquares) {
  Told told;
  look_many(told, 0.0, 42.0, 30);
  prior(told, {6.0, -4.0, 2.0});
  const CalibrationVector calibration = drawn<CalibrationVector>();
  const Point expected = best_position(told, head_with(calibration));
  EXPECT_LT((position_of(told.landmark, calibration, drift_) - expected).norm(), 1e-9);
  told.landmark.freeze(0, drift_);
  EXPECT_LT((position_of(told.landmark, calibration, drift_) - expected).norm(), 1e-9);
  freeze_spell();
  EXPECT_LT((position_of(told.landmark, calibration, drift_) - expected).norm(), 1e-9);
}

// --- The sway.

TEST_F(LandmarkSums, AreTiedToTheSpellsThatAreEstimated) {
  Told told;
  look_many(told, 0.0, 3.9, 30);
  EXPECT_EQ(spells_of(told), (Numbers{0, 1, 2, 3}));
  expect_same_costs(told);
  look_many(told, 3.9, 12.9, 60);
  EXPECT_EQ(spells_of(told), (Numbers{7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(frozen_spells_.size(), 7U);
  expect_same_costs(told);
}

TEST_F(LandmarkSums, OfAFrozenSpellSayWhatTheLooksSayAtItsEstimate) {
  Told told;
  look_many(told, 0.0, 7.9, 40);  // spells on both sides of a node
  while (drift_.sway().size() > 1) {
    const std::uint32_t oldest = drift_.sway().begin();
    ASSERT_EQ(spells_of(told).front(), oldest);
    freeze_spell();
    ASSERT_EQ(spells_of(told).front(), oldest + 1);
    expect_same_costs(told);
  }
}

TEST_F(LandmarkSums, OfFrozenNodesAndSpellsSayWhatTheLooksSayAtTheirEstimates) {
  Told both[2];
  for (const bool node_first : {false, true}) {
    Told& told = both[node_first ? 1 : 0];
    const double begin_s = node_first ? 300.0 : 0.0;
    look_many(told, begin_s, begin_s + 6.9, 40);
    Nodes frozen;
    const std::uint32_t oldest = told.landmark.begin()->number;
    for (std::uint32_t node = oldest; node != oldest + 3; ++node) {
      if (!node_first) freeze_spell();
      frozen[node] = drift_.node(node).mean;
      told.landmark.freeze(node, drift_);
      expect_same_costs(told, frozen);
      if (node_first) freeze_spell();
      expect_same_costs(told, frozen);
    }
  }
}

TEST_F(LandmarkSums, AreNotConcernedByASpellInWhichNoLookWas) {
  Told told, other;
  look_many(told, 0.0, 0.9, 3);
  look_many(other, 1.0, 1.9, 3);
  look_many(told, 2.0, 2.9, 3);
  EXPECT_EQ(spells_of(told), (Numbers{0, 2}));
  freeze_spell();
  freeze_spell();
  EXPECT_EQ(spells_of(told), (Numbers{2}));
  expect_same_costs(told);
  Told untouched;
  untouched.landmark.freeze_spell(2, drift_);
  EXPECT_EQ(spells_of(untouched), Numbers{});
}

/// A look that is taken in when its spell is frozen already, as one that is linearised anew.
TEST_F(LandmarkSums, OfALookInAFrozenSpellAreOffByItsEstimate) {
  Told told, late;
  look_many(told, 0.0, 12.9, 50);
  late.priors = told.priors;
  for (const LandmarkObservation& look : told.looks) {
    late.looks.push_back(look);
    late.landmark.add(look, drift_);
  }
  ASSERT_EQ(drift_.sway().begin(), 7U);
  EXPECT_EQ(spells_of(late), (Numbers{7, 8, 9, 10, 11, 12}));
  expect_same_costs(late);
}

TEST_F(LandmarkSums, WithoutASwaySayWhatTheLooksSay) {
  DriftConfig without = config();
  without.max_spells = 0;
  drift_ = DriftTimeline(without);
  Told told;
  look_many(told, 0.0, 12.0, 20);
  EXPECT_EQ(spells_of(told), Numbers{});
  expect_same_costs(told);
}

TEST_F(LandmarkSums, OfTwoLandmarksInTheSameSpellsAndInOthersSayWhatTheLooksOfBothSay) {
  Told one, other;
  look_many(one, 0.0, 8.9, 30);
  look_many(other, 8.0, 10.9, 12);
  look_many(one, 10.0, 12.9, 12);
  look_many(other, 12.0, 12.9, 6);
  ASSERT_EQ(spells_of(one), (Numbers{7, 8, 10, 11, 12}));
  ASSERT_EQ(spells_of(other), (Numbers{8, 9, 10, 12}));
  for (const bool is_turned : {false, true}) {
    Told both = is_turned ? other : one;
    const Told& merged = is_turned ? one : other;
    both.looks.insert(both.looks.end(), merged.looks.begin(), merged.looks.end());
    both.landmark.merge(merged.landmark, drift_);
    EXPECT_EQ(spells_of(both), (Numbers{7, 8, 9, 10, 11, 12}));
    expect_same_costs(both);
  }
}

/// In the quadratic form, for any state: not only where it stands now.
TEST_F(LandmarkSums, OfAFrozenLatencySayWhatTheLooksSayAtIt) {
  Told told;
  look_many(told, 0.0, 12.9, 40);
  constexpr int kLatency = CalibrationIndex::kLatency;
  constexpr double kFrozen_s = 0.7;
  told.landmark.freeze_latency(kFrozen_s);
  double offset = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    const Point x = drawn<Point>();
    Head head = drawn_head();
    const double of_sums = cost(told.landmark, x, head);
    head.calibration[kLatency] = kFrozen_s;
    const double expected = cost(told, x, head);
    if (trial == 0) offset = expected - of_sums;
    EXPECT_NEAR(expected - of_sums, offset, 1e-9 * (1.0 + expected));
  }
}

TEST_F(LandmarkSums, FreezeTheOldestSpellsWhereThereAreTooMany) {
  bounds_spells_ = false;
  Told told;
  look_many(told, 0.0, 11.9, 60);
  EXPECT_EQ(spells_of(told), (Numbers{4, 5, 6, 7, 8, 9, 10, 11}));
  for (const std::uint32_t number : {0U, 1U, 2U, 3U})
    frozen_spells_[number] = drift_.sway().spell(number).mean;
  expect_same_costs(told);
}

// --- Nodes that are thinned out.

/// Looks over seven nodes, of which the last seconds' alone are in spells that are estimated.
class ThinnedLandmarkSums : public LandmarkSums {
 protected:
  ThinnedNode drawn_thinning(std::uint32_t number, double weight_of_next) {
    return {number, weight_of_next, drawn<NodeVector>()};
  }
};

TEST_F(ThinnedLandmarkSums, SayWhatTheLooksSayWithTheNodeOnTheLineBetweenItsNeighbours) {
  Told told;
  look_many(told, 0.0, 29.9, 60);
  while (drift_.sway().spell(drift_.sway().begin()).node <= 4) freeze_spell();
  ASSERT_EQ(spells_of(told), (Numbers{25, 26, 27, 28, 29}));
  const Landmark untouched = told.landmark;
  for (const std::uint32_t number : {1U, 2U, 3U, 4U}) {  // at the oldest, in between, just before the spells
    for (const double weight : {0.3, 0.5, 0.9}) {
      told.landmark = untouched;
      const ThinnedNode node = drawn_thinning(number, weight);
      told.landmark.thin(node, drift_);
      EXPECT_EQ(nodes_of(told), (Numbers{1, 2, 3, 4, 5, 6}));
      expect_same_costs(told, {}, {node});
    }
  }
}

/// Nodes 1, 2 and 3 stand at 5, 10 and 15 s; 2 goes. Seen on one side of it, on both, on neither.
TEST_F(ThinnedLandmarkSums, OfAnObjectSeenAtSomeOfTheNodesSayTheSame) {
  Told before, after, both_sides, neither, far_before, far_after, outer, nothing;
  Told* const all[] = {&before, &after, &both_sides, &neither, &far_before, &far_after, &outer};
  const auto look_at = [this](const std::vector<Told*>& seen, double begin_s, double end_s) {
    for (int i = 0; i < 8; ++i)
      for (Told* told : seen) look(*told, begin_s + (end_s - begin_s) * i / 8);
  };
  look_at({&far_before, &neither, &outer}, 0.0, 4.9);  // nodes 0, 1
  look_at({&before, &both_sides}, 5.1, 9.9);           // 1, 2
  look_at({&after, &both_sides}, 10.1, 14.9);          // 2, 3
  look_at({&far_after, &neither}, 15.1, 19.9);         // 3, 4
  look_at({&outer}, 20.1, 24.9);                       // 4, 5
  look_at({&before}, 25.1, 29.9);                      // 5, 6
  const ThinnedNode node = drawn_thinning(2, 0.35);
  for (Told* told : all) {
    told->landmark.thin(node, drift_);
    expect_same_costs(*told, {}, {node});
  }
  EXPECT_EQ(nodes_of(before), (Numbers{2, 3, 5, 6}));
  EXPECT_EQ(nodes_of(after), (Numbers{2, 3}));
  EXPECT_EQ(nodes_of(both_sides), (Numbers{2, 3}));
  EXPECT_EQ(nodes_of(neither), (Numbers{1, 2, 3, 4}));
  EXPECT_EQ(nodes_of(far_before), (Numbers{1, 2}));
  EXPECT_EQ(nodes_of(far_after), (Numbers{3, 4}));
  EXPECT_EQ(nodes_of(outer), (Numbers{1, 2, 4, 5}));
  nothing.landmark.thin(node, drift_);
  EXPECT_EQ(nodes_of(nothing), Numbers{});
}

TEST_F(ThinnedLandmarkSums, SayTheSameOfNodesThinnedOneAfterAnother) {
  Told told;
  look_many(told, 0.0, 39.9, 80);  // nodes 0 to 8
  std::vector<ThinnedNode> thinned;
  for (const std::uint32_t number : {3U, 5U, 4U, 5U}) {
    thinned.push_back(drawn_thinning(number, 0.2 + 0.1 * number));
    told.landmark.thin(thinned.back(), drift_);
    expect_same_costs(told, {}, thinned);
  }
  EXPECT_EQ(nodes_of(told), (Numbers{4, 5, 6, 7, 8}));
}

/// Frozen nodes, looks to come and merging go on as before.
TEST_F(ThinnedLandmarkSums, GoOnFromThere) {
  Told told, other;
  for (int i = 0; i < 90; ++i) look(i % 3 == 2 && i > 40 ? other : told, i / 3.0);
  const Nodes means_before = means();
  const auto node = drift_.next_to_thin();
  ASSERT_TRUE(node);
  ASSERT_EQ(node->number, 1U);
  told.landmark.thin(*node, drift_);
  other.landmark.thin(*node, drift_);
  drift_.thin(*node);
  look_many(told, 30.0, 37.0, 10);
  expect_same_costs(told, {}, {*node});
  told.looks.insert(told.looks.end(), other.looks.begin(), other.looks.end());
  told.landmark.merge(other.landmark, drift_);
  expect_same_costs(told, {}, {*node});
  const std::uint32_t oldest = drift_.begin();
  ASSERT_EQ(drift_.node(oldest).mean, means_before.at(0));
  const NodeVector frozen = drift_.node(oldest).mean;
  told.landmark.freeze(oldest, drift_);
  expect_same_costs(told, {{oldest, frozen}}, {*node});
}

/// An object seen at as many nodes as there is room for, the oldest of which has no neighbour among them: it
/// is taken as estimated.
TEST_F(ThinnedLandmarkSums, FreezeANodeWhoseNeighboursThereIsNoRoomFor) {
  Told told, other;
  look_many(told, 0.0, 4.9, 5);
  look_many(other, 5.0, 14.9, 10);
  constexpr std::uint32_t kLast = Landmark::kMaxNodes + 1;
  look_many(told, 15.1, 5.0 * kLast - 0.1, 6 * static_cast<int>(kLast));
  Numbers from_third(kLast - 2);
  std::iota(from_third.begin(), from_third.end(), 3U);
  Numbers seen = from_third;
  seen.insert(seen.begin(), 1U);
  ASSERT_EQ(nodes_of(told), seen);
  const auto mean = [this](std::uint32_t number) { return drift_.node(number).mean; };
  const ThinnedNode node{1, 0.4, mean(1) - 0.6 * mean(0) - 0.4 * mean(2)};
  told.landmark.thin(node, drift_);
  EXPECT_EQ(nodes_of(told), from_third);
  expect_same_costs(told, {{1, mean(0)}, {2, mean(2)}}, {node});
}

/// The node is where its estimate is until the next solution.
TEST_F(ThinnedLandmarkSums, ShowTheObjectWhereTheyDid) {
  Told told;
  look_many(told, 0.0, 39.9, 80);
  const CalibrationVector calibration = drawn<CalibrationVector>();
  const Point expected = position_of(told.landmark, calibration, drift_);
  for (int i = 0; i < 4; ++i) {
    const auto node = drift_.next_to_thin();
    ASSERT_TRUE(node);
    told.landmark.thin(*node, drift_);
    drift_.thin(*node);
    EXPECT_LT((position_of(told.landmark, calibration, drift_) - expected).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace geoloc
