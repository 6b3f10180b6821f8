// SPDX-License-Identifier: Apache-2.0
#include "calibration/arrowhead.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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
        const double root = std::sqrt(node.information[i]) / (i < 2 ? drift_.position_scale() : 1.0);
        rows.push_back(root * row);
        values.push_back(root * node.prior_mean[i]);
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

/// By its definition from the dense solution: the mean square of the nodes' steps, in units of the prior's.
TEST_F(ArrowheadProblem, ObservedWanderingIsTheExpectedSquareOfTheSteps) {
  make(5, 300, 44.0);
  drift_.set_position_scale(0.7);
  solver_.solve(all(), kOffsetSigma_m, drift_, calibration_);
  const Dense expected = dense({0, 1, 2, 3, 4});
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t number = 1; number != drift_.end(); ++number) {
    const DriftNode& node = drift_.node(number);
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(expected.solution.size());
      const Eigen::Index at =
          10 + CalibrationIndex::kSize + kNodeSize * static_cast<Eigen::Index>(number) + axis;
      step[at] = 1.0;
      step[at - kNodeSize] = -node.transition[axis];
      const double mean = step.dot(expected.solution), variance = step.dot(expected.covariance * step);
      sum += (mean * mean + variance) * node.information[axis];
      ++count;
    }
  }
  const auto observed = solver_.observed_wandering(drift_);
  ASSERT_TRUE(observed);
  EXPECT_NEAR(*observed, std::sqrt(sum / count), 1e-8);
}

TEST_F(ArrowheadProblem, ObservedWanderingNeedsEightNodes) {
  make(2, 30, 29.0);  // 7 nodes, five seconds apart
  ASSERT_EQ(drift_.size(), 7);
  ASSERT_TRUE(solver_.solve(all(), kOffsetSigma_m, drift_, calibration_));
  EXPECT_FALSE(solver_.observed_wandering(drift_));
  drift_.cover(VehicleTime{from_seconds(31.0)}, kWanderSigma_m);
  ASSERT_TRUE(solver_.solve(all(), kOffsetSigma_m, drift_, calibration_));
  EXPECT_TRUE(solver_.observed_wandering(drift_));
}

/// Looks from a vehicle whose position wanders by a Gauss-Markov process of known strength, two objects in
/// view at any time and each for a minute.
TEST(ObservedWandering, ConvergesOnTheStrengthOfASimulatedProcess) {
  constexpr int kNodes = 150, kNodesInView = 12;
  constexpr double kNoise_m = 0.02;
  DriftConfig config;
  config.max_nodes = kNodes;
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto drawn = [&] { return Eigen::Vector2d(normal(random), normal(random)); };
  for (const double strength : {0.3, 1.0, 2.5}) {
    DriftTimeline drift(config);
    drift.cover(VehicleTime{}, kWanderSigma_m);  // the first node is at 0
    std::vector<Landmark> landmarks(2 + 2 * kNodes / kNodesInView);
    const double sigma_m = strength * kWanderSigma_m;
    const double kept = std::exp(-config.node_spacing_s / config.position_time_constant_s);
    Eigen::Vector2d before = sigma_m * drawn();
    for (int node = 0; node + 1 < kNodes; ++node) {
      const Eigen::Vector2d after = kept * before + sigma_m * std::sqrt(1.0 - kept * kept) * drawn();
      for (int i = 0; i < 10; ++i) {
        LandmarkObservation look;
        const double time_s = config.node_spacing_s * (node + 0.05 + 0.1 * i);
        look.span = drift.cover(VehicleTime{from_seconds(time_s)}, kWanderSigma_m);
        const double weight = look.span.weight_of_second;
        look.value = kNoise_m * drawn() - (1.0 - weight) * before - weight * after;
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
      if (landmark.A().trace() > 0.0) seen.push_back(&landmark);
    }
    ArrowheadSolver solver(CalibrationPrior{}, kNodes);
    Calibration calibration;
    for (int round = 0; round < 10; ++round) {
      ASSERT_TRUE(solver.solve(seen, kOffsetSigma_m, drift, calibration));
      drift.set_position_scale(*solver.observed_wandering(drift));
    }
    // 149 steps on two axes: 4 % of sampling error.
    EXPECT_NEAR(drift.position_scale(), strength, 0.12 * strength);
  }
}

TEST_F(ArrowheadProblem, AnObjectKnownFromASurveyAloneHasThatCovariance) {
  make(2, 40, 12.0);
  Landmark surveyed;
  const Eigen::Matrix2d covariance = (Eigen::Matrix2d() << 0.04, 0.01, 0.01, 0.09).finished();
  surveyed.add_prior({3.0, 4.0}, covariance.inverse());
  const std::vector<const Landmark*> landmarks{&landmarks_[0], &landmarks_[1], &surveyed};
  ASSERT_TRUE(solver_.solve(landmarks, kOffsetSigma_m, drift_, calibration_));
  EXPECT_LT((solver_.covariance(surveyed, drift_) - covariance).norm(), 1e-12);
  EXPECT_LT((surveyed.position(calibration_.mean, drift_) - Eigen::Vector2d(3.0, 4.0)).norm(), 1e-12);
  const Eigen::Matrix2d difference = covariance + solver_.covariance(landmarks_[0], drift_);
  EXPECT_LT((solver_.covariance_of_difference(surveyed, landmarks_[0], drift_) - difference).norm(), 1e-9);
}

TEST_F(ArrowheadProblem, WhatIsNoNumberSetsNothing) {
  make(2, 40, 12.0);
  ASSERT_TRUE(solver_.solve(all(), kOffsetSigma_m, drift_, calibration_));
  const Calibration before = calibration_;
  const NodeVector node_before = drift_.node(0).mean;
  Landmark broken;
  broken.add_prior({0.0, 0.0}, Eigen::Matrix2d::Constant(std::nan("")));
  EXPECT_FALSE(solver_.solve({&landmarks_[0], &broken}, kOffsetSigma_m, drift_, calibration_));
  EXPECT_EQ(calibration_.mean, before.mean);
  EXPECT_EQ(drift_.node(0).mean, node_before);
}

TEST(ArrowheadSolver, StatesThePriorInRadiansMetresAndSeconds) {
  CalibrationPrior prior;
  prior.boresight_x_deg = 1.0;
  prior.boresight_y_deg = -2.0;
  prior.boresight_z_deg = 3.0;
  prior.latency_s = 0.1;
  prior.height_m = -0.4;
  prior.sigma_boresight_x_deg = 4.0;
  prior.sigma_boresight_y_deg = 5.0;
  prior.sigma_boresight_z_deg = 0.0;
  prior.sigma_latency_s = 0.2;
  prior.sigma_height_m = 0.6;
  const ArrowheadSolver solver(prior, 10);
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  CalibrationVector mean, sigma;
  mean << kDegree, -2.0 * kDegree, 3.0 * kDegree, 0.1, -0.4, 0.0, 0.0;
  sigma << 4.0 * kDegree, 5.0 * kDegree, 0.0, 0.2, 0.6, 0.7, 0.7;
  EXPECT_LT((solver.prior_mean() - mean).norm(), 1e-12);
  EXPECT_LT((solver.prior_sigma(0.7) - sigma).norm(), 1e-8);
  EXPECT_GT(solver.prior_sigma(0.7).minCoeff(), 0.0);  // its inverse is finite
}

}  // namespace
}  // namespace geoloc
