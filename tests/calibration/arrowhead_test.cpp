// SPDX-License-Identifier: Apache-2.0
#include "calibration/arrowhead.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr double kOffsetSigma_m = 0.3;
constexpr double kWanderSigma_m = 0.4;

/// Random looks at random objects, over some drift nodes.
class ArrowheadProblem : public ::testing::Test {
 protected:
  struct Look {
    std::size_t object;
    LandmarkObservation observation;
  };

  void make(std::size_t objects, int looks, double duration_s) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    landmarks_.assign(objects, Landmark{});
    for (int i = 0; i < looks; ++i) {
      Look look;
      look.object = static_cast<std::size_t>(i) % objects;
      auto& o = look.observation;
      o.span = drift_.cover(VehicleTime{from_seconds(duration_s * i / looks)}, kWanderSigma_m);
      for (double& value : o.calibration_jacobian.reshaped()) value = normal(random);
      for (double& value : o.node_jacobian.reshaped()) value = normal(random);
      o.value = {10.0 * static_cast<double>(look.object) + normal(random), normal(random)};
      Eigen::Matrix2d root;
      for (double& value : root.reshaped()) value = normal(random);
      o.information = root * root.transpose() + Eigen::Matrix2d::Identity();
      looks_.push_back(look);
      landmarks_[look.object].add(o, drift_);
    }
  }

  std::vector<const Landmark*> all() const {
    std::vector<const Landmark*> pointers;
    for (const Landmark& landmark : landmarks_) pointers.push_back(&landmark);
    return pointers;
  }

  /// The same problem as one dense least-squares system over objects, calibration and nodes, solved by QR.
  struct Dense {
    Eigen::VectorXd solution;  // objects (2 each), calibration, nodes
    Eigen::MatrixXd covariance;
  };
  Dense dense(const std::vector<std::size_t>& object_of) const {
    const auto objects = static_cast<Eigen::Index>(1 + *std::max_element(object_of.begin(), object_of.end()));
    const Eigen::Index head = 2 * objects, nodes = drift_.size();
    const Eigen::Index size = head + CalibrationIndex::kSize + kNodeSize * nodes;
    const auto node_column = [&](std::uint32_t number) {
      return head + CalibrationIndex::kSize + kNodeSize * static_cast<Eigen::Index>(number - drift_.begin());
    };
    std::vector<Eigen::RowVectorXd> rows;
    std::vector<double> values;
    for (const Look& look : looks_) {
      const auto& o = look.observation;
      const Eigen::Matrix2d root = o.information.llt().matrixU();
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(2, size);
      row.middleCols<2>(2 * static_cast<Eigen::Index>(object_of[look.object])).setIdentity();
      row.middleCols<CalibrationIndex::kSize>(head) = -o.calibration_jacobian;
      row.middleCols<kNodeSize>(node_column(o.span.first)) -= (1 - o.span.weight_of_second) * o.node_jacobian;
      row.middleCols<kNodeSize>(node_column(o.span.first + 1)) -= o.span.weight_of_second * o.node_jacobian;
      row = root * row;
      const Eigen::Vector2d value = root * o.value;
      for (int i = 0; i < 2; ++i) {
        rows.push_back(row.row(i));
        values.push_back(value[i]);
      }
    }
    const CalibrationVector sigma = solver_.prior_sigma(kOffsetSigma_m);
    for (int i = 0; i < CalibrationIndex::kSize; ++i) {
      rows.push_back(Eigen::RowVectorXd::Unit(size, head + i) / sigma[i]);
      values.push_back(solver_.prior_mean()[i] / sigma[i]);
    }
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
      const DriftNode& node = drift_.node(number);
      for (int i = 0; i < kNodeSize; ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(size, node_column(number) + i);
        if (number != drift_.begin()) row[node_column(number - 1) + i] = -node.transition[i];
        rows.push_back(std::sqrt(node.information[i]) * row);
        values.push_back(std::sqrt(node.information[i]) * node.prior_mean[i]);
      }
    }
    Eigen::MatrixXd A(static_cast<Eigen::Index>(rows.size()), size);
    for (std::size_t i = 0; i < rows.size(); ++i) A.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Eigen::VectorXd b =
        Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    return {A.colPivHouseholderQr().solve(b), (A.transpose() * A).inverse()};
  }

  DriftTimeline drift_{DriftConfig{}};
  CalibrationPrior prior_;
  ArrowheadSolver solver_{prior_, DriftConfig{}.max_nodes};
  Calibration calibration_;
  std::vector<Landmark> landmarks_;
  std::vector<Look> looks_;
};

TEST_F(ArrowheadProblem, SolutionAndCovariancesAreThoseOfDenseLeastSquares) {
  make(5, 200, 40.0);
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  const Dense expected = dense({0, 1, 2, 3, 4});
  EXPECT_LT((calibration_.mean - expected.solution.segment<CalibrationIndex::kSize>(10)).norm(), 1e-8);
  EXPECT_LT((calibration_.covariance -
             expected.covariance.block<CalibrationIndex::kSize, CalibrationIndex::kSize>(10, 10))
                .norm(),
            1e-8);
  EXPECT_LT((solver_.newest_node_covariance() - expected.covariance.bottomRightCorner<kNodeSize, kNodeSize>())
                .norm(),
            1e-8);
  for (Eigen::Index j = 0; j < 5; ++j) {
    const Landmark& landmark = landmarks_[static_cast<std::size_t>(j)];
    EXPECT_LT((landmark.position(calibration_.mean, drift_) - expected.solution.segment<2>(2 * j)).norm(),
              1e-8);
    EXPECT_LT((solver_.covariance(landmark, drift_) - expected.covariance.block<2, 2>(2 * j, 2 * j)).norm(),
              1e-8);
  }
  const Eigen::Matrix2d difference =
      expected.covariance.block<2, 2>(0, 0) + expected.covariance.block<2, 2>(2, 2) -
      expected.covariance.block<2, 2>(0, 2) - expected.covariance.block<2, 2>(2, 0);
  EXPECT_LT((solver_.covariance_of_difference(landmarks_[0], landmarks_[1], drift_) - difference).norm(),
            1e-8);
}

TEST_F(ArrowheadProblem, MergingSumsIsHavingSeenOneObject) {
  make(4, 160, 30.0);
  landmarks_[1].merge(landmarks_[3], drift_);
  landmarks_.pop_back();
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  const Dense expected = dense({0, 1, 2, 1});
  EXPECT_LT((calibration_.mean - expected.solution.segment<CalibrationIndex::kSize>(6)).norm(), 1e-8);
  EXPECT_LT((landmarks_[1].position(calibration_.mean, drift_) - expected.solution.segment<2>(2)).norm(),
            1e-8);
}

TEST_F(ArrowheadProblem, LeavingAnObjectOutIsNeverHavingSeenIt) {
  make(3, 90, 20.0);
  landmarks_.pop_back();
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  looks_.erase(
      std::remove_if(looks_.begin(), looks_.end(), [](const Look& look) { return look.object == 2; }),
      looks_.end());
  const Dense expected = dense({0, 1});
  EXPECT_LT((calibration_.mean - expected.solution.segment<CalibrationIndex::kSize>(4)).norm(), 1e-8);
}

TEST_F(ArrowheadProblem, OneLookAtAnObjectSaysNothingOfTheCalibration) {
  make(6, 6, 2.0);
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  EXPECT_LT((calibration_.mean - solver_.prior_mean()).norm(), 1e-9);
  const CalibrationVector sigma = solver_.prior_sigma(kOffsetSigma_m);
  for (int i = 0; i < CalibrationIndex::kSize; ++i) EXPECT_NEAR(calibration_.sigma(i), sigma[i], 1e-6);
}

TEST_F(ArrowheadProblem, AFrozenComponentStaysWhereItIs) {
  CalibrationPrior prior;
  prior.latency_s = 0.123;
  prior.sigma_latency_s = 0.0;
  make(4, 100, 20.0);
  ArrowheadSolver frozen(prior, DriftConfig{}.max_nodes);
  frozen.solve(all(), kOffsetSigma_m, drift_, calibration_);
  EXPECT_NEAR(calibration_.latency_s(), 0.123, 1e-6);
  EXPECT_LT(calibration_.sigma(CalibrationIndex::kLatency), 1e-6);
}

TEST_F(ArrowheadProblem, FreezingANodeAtItsEstimateChangesNoEstimate) {
  make(4, 160, 40.0);
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  const CalibrationVector before = calibration_.mean;
  const Eigen::Vector2d position = landmarks_[2].position(calibration_.mean, drift_);
  for (Landmark& landmark : landmarks_) landmark.freeze(drift_.begin(), drift_);
  drift_.freeze_oldest();
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  EXPECT_LT((calibration_.mean - before).norm(), 1e-8);
  EXPECT_LT((landmarks_[2].position(calibration_.mean, drift_) - position).norm(), 1e-8);
}

TEST(DriftTimeline, CoversEveryTimeByTwoNodesAndSkipsPauses) {
  DriftTimeline drift{DriftConfig{}};
  for (const double time_s : {0.0, 1.0, 4.99, 5.01, 11.0, 500.0, 503.0}) {
    const NodeSpan span = drift.cover(VehicleTime{from_seconds(time_s)}, 0.5);
    EXPECT_GE(span.weight_of_second, 0.0);
    EXPECT_LE(span.weight_of_second, 1.0);
    const double first_s = seconds(drift.node(span.first).time.time_since_epoch());
    const double second_s = seconds(drift.node(span.first + 1).time.time_since_epoch());
    EXPECT_NEAR((1 - span.weight_of_second) * first_s + span.weight_of_second * second_s, time_s, 1e-6);
  }
  EXPECT_LT(drift.size(), 10);  // none for the eight minutes in which nothing was seen
}

TEST(DriftTimeline, BeginsAnewWhenTheClockRunsBack) {
  DriftTimeline drift{DriftConfig{}};
  drift.cover(VehicleTime{from_seconds(100.0)}, 0.5);
  const NodeSpan span = drift.cover(VehicleTime{from_seconds(3.0)}, 0.5);
  EXPECT_EQ(drift.node(span.first).transition, NodeVector(NodeVector::Zero()));
}

}  // namespace
}  // namespace geoloc
