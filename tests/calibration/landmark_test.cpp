// SPDX-License-Identifier: Apache-2.0
#include "calibration/landmark.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <random>
#include <vector>

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

  void look(Told& told, double time_s) {
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
    told.looks.push_back(look);
    told.landmark.add(look, drift_);
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

  Nodes drawn_nodes() {
    Nodes nodes;
    for (std::uint32_t number = 0; number != drift_.end(); ++number) nodes[number] = drawn<NodeVector>();
    return nodes;
  }

  /// A point that is higher by one appears moved by the slope against it.
  static Eigen::Vector2d shown(const LandmarkObservation& look, const Point& x) {
    return {x[0] - look.slope[0] * x[2], x[1] - look.slope[1] * x[2]};
  }

  /// Sum of the squared residuals, look by look: by the definition of a look.
  static double cost(const Told& told, const Point& x, const CalibrationVector& c, const Nodes& nodes) {
    double sum = 0.0;
    for (const LandmarkObservation& look : told.looks) {
      const double second = look.span.weight_of_second;
      const NodeVector drift =
          (1.0 - second) * nodes.at(look.span.first) + second * nodes.at(look.span.first + 1);
      const Eigen::Vector2d residual =
          look.value + look.calibration_jacobian * c + look.node_jacobian * drift - shown(look, x);
      sum += residual.dot(look.information * residual);
    }
    for (const Prior& prior : told.priors)
      sum += (prior.position - x).dot(prior.information * (prior.position - x));
    return sum;
  }

  /// The same from the sums, but for a constant.
  static double cost(const Landmark& sums, const Point& x, const CalibrationVector& c, const Nodes& nodes) {
    Point linear = sums.b() + sums.B() * c;
    double cost = c.dot(sums.C() * c) - 2.0 * sums.g().dot(c);
    for (const Landmark::NodeTerms& terms : sums) {
      const NodeVector& d = nodes.at(terms.number);
      linear += terms.B * d;
      cost += d.dot(terms.C_own * d) + 2.0 * c.dot(terms.C_calibration * d) - 2.0 * terms.g.dot(d);
      const auto next = nodes.find(terms.number + 1);
      if (next != nodes.end()) cost += 2.0 * d.dot(terms.C_next * next->second);
    }
    return cost + x.dot(sums.A() * x) - 2.0 * x.dot(linear);
  }

  /// Both agree on how much worse any state is than another. `frozen`: nodes whose value is not asked for.
  void expect_same_costs(const Told& told, const Nodes& frozen = {}) {
    double offset = 0.0;
    for (int trial = 0; trial < 10; ++trial) {
      const Point x = 3.0 * drawn<Point>();
      const CalibrationVector c = drawn<CalibrationVector>();
      Nodes nodes = drawn_nodes();
      for (const auto& [number, value] : frozen) nodes[number] = value;
      const double expected = cost(told, x, c, nodes);
      const double difference = expected - cost(told.landmark, x, c, nodes);
      if (trial == 0) offset = difference;
      EXPECT_NEAR(difference, offset, 1e-9 * (1.0 + expected));
    }
  }

  /// Weighted least squares over all looks with everything else known, by QR.
  static Point best_position(const Told& told, const CalibrationVector& c, const Nodes& nodes) {
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
      const double second = look.span.weight_of_second;
      Eigen::MatrixXd by_point(2, 3);
      by_point << 1.0, 0.0, -look.slope[0], 0.0, 1.0, -look.slope[1];
      add(look.information, by_point,
          look.value + look.calibration_jacobian * c +
              look.node_jacobian *
                  ((1.0 - second) * nodes.at(look.span.first) + second * nodes.at(look.span.first + 1)));
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

  DriftTimeline drift_{DriftConfig{}};

 private:
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
  std::uint32_t known_up_to_ = 0;
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
  const NodeVector drift = (1.0 - look.span.weight_of_second) * means().at(look.span.first) +
                           look.span.weight_of_second * means().at(look.span.first + 1);
  const Eigen::Vector2d level =
      look.value + look.calibration_jacobian * calibration + look.node_jacobian * drift;
  const Point position = told.landmark.position(calibration, drift_);
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
  const Point before = told.landmark.position(calibration, drift_);
  told.landmark.freeze_latency(calibration[CalibrationIndex::kLatency]);
  calibration[CalibrationIndex::kLatency] += 7.0;
  EXPECT_LT((told.landmark.position(calibration, drift_) - before).norm(), 1e-9);
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
  look_many(told, 0.0, 97.0, 120);  // 21 nodes, five apart
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
  const Point expected = best_position(told, calibration, means());
  EXPECT_LT((told.landmark.position(calibration, drift_) - expected).norm(), 1e-9);
  told.landmark.freeze(0, drift_);
  EXPECT_LT((told.landmark.position(calibration, drift_) - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace geoloc
