// SPDX-License-Identifier: Apache-2.0
#include "calibration/shared_error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace geoloc {
namespace {

using Index = CalibrationIndex;

TEST(PositionAccuracy, DividesAmongTheAxesAndBetweenWhatStaysAndWhatWanders) {
  const PositionAccuracy accuracy{2.0, 0.25, 0.1};
  const double wandering = accuracy.wandering_sigma_m(), offset = accuracy.offset_sigma_m(1.0);
  EXPECT_NEAR(2.0 * (wandering * wandering + offset * offset), 4.0, 1e-12);  // the radius' square
  EXPECT_NEAR(offset * offset / (wandering * wandering), 0.25 / 0.75, 1e-12);
}

TEST(PositionAccuracy, OfAReceiverThatWandersLessIsBetterButForAFloor) {
  const PositionAccuracy accuracy{2.0, 0.25, 0.1};
  EXPECT_NEAR(accuracy.offset_sigma_m(0.5), 0.5 * accuracy.offset_sigma_m(1.0), 1e-12);
  EXPECT_NEAR(accuracy.offset_sigma_m(2.0), 2.0 * accuracy.offset_sigma_m(1.0), 1e-12);
  EXPECT_EQ(accuracy.offset_sigma_m(0.01), 0.1);
}

class SharedErrors : public ::testing::Test {
 protected:
  /// Takes over the solution of some random looks at two objects.
  void learn() {
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    const auto fill = [&](auto&& matrix) {
      for (double& value : matrix.reshaped()) value = normal(random);
    };
    for (int i = 0; i < 60; ++i) {
      LandmarkObservation look;
      look.span = estimate_.drift.cover(VehicleTime{from_seconds(0.3 * i)}, 0.5);
      fill(look.calibration_jacobian);
      fill(look.node_jacobian);
      fill(look.value);
      look.information = 4.0 * Eigen::Matrix2d::Identity();
      landmarks_[i % 2].add(look, estimate_.drift);
    }
    estimate_.take(solution());
  }

  ArrowheadSolver::Solution solution() {
    return *solver_.solve({&landmarks_[0], &landmarks_[1]}, estimate_.offset_sigma_m(), estimate_.drift);
  }

  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}.max_nodes};
  PositionAccuracy accuracy_{1.0, 0.2, 0.02};
  SharedErrorEstimate estimate_{accuracy_, DriftConfig{}, solver_};
  Landmark landmarks_[2];
};

TEST_F(SharedErrors, BeginAsThePrior) {
  const Calibration prior = solver_.prior(accuracy_.offset_sigma_m(1.0));
  EXPECT_EQ(estimate_.calibration.mean, prior.mean);
  EXPECT_EQ(estimate_.calibration.covariance, prior.covariance);
  EXPECT_EQ(estimate_.offset_sigma_m(), accuracy_.offset_sigma_m(1.0));
}

/// A component frozen by a sigma of 0 leaves the others' roots what they are.
TEST(FrozenSharedErrors, HaveARootBesideTheOthers) {
  CalibrationPrior prior;
  prior.sigma_boresight_y_deg = 0.0;
  const ArrowheadSolver solver(prior, DriftConfig{}.max_nodes);
  const SharedErrorEstimate estimate({1.0, 0.2, 0.02}, DriftConfig{}, solver);
  EXPECT_NEAR(estimate.calibration_root(Index::kBoresight + 1, Index::kBoresight + 1), 0.0, 1e-8);
  for (const int free : {Index::kBoresight, Index::kBoresight + 2, Index::kLatency, Index::kHeight})
    EXPECT_NEAR(estimate.calibration_root(free, free), estimate.calibration.sigma(free), 1e-9);
}

TEST_F(SharedErrors, TakeOverWhatWasSolved) {
  learn();
  const ArrowheadSolver::Solution again = solution();
  EXPECT_EQ(estimate_.calibration.mean, again.calibration().mean);
  EXPECT_EQ(estimate_.calibration.covariance, again.calibration().covariance);
  for (std::uint32_t number = 0; number != estimate_.drift.end(); ++number)
    EXPECT_EQ(estimate_.drift.node(number).mean, again.node(number));
}

TEST_F(SharedErrors, AreLessWhereThePositionWandersLess) {
  estimate_.drift.set_position_scale(0.5);
  EXPECT_NEAR(estimate_.offset_sigma_m(), accuracy_.offset_sigma_m(0.5), 1e-15);
}

/// A whitened Jacobian's square is the covariance that its errors cause; before and after learning.
TEST_F(SharedErrors, WhitenJacobians) {
  for (const bool is_learnt : {false, true}) {
    if (is_learnt) learn();
    SharedError::CalibrationRow by_calibration;
    by_calibration << 1, -2, 3, 0.5, -1, 0.3, 2, -1, 4, 1.5;
    Eigen::Matrix<double, 2, kNodeSize> by_drift;
    by_drift << 1, 0, -2, 0, 1, 3;
    const SharedError::Row row = estimate_.whitened(by_calibration, by_drift);
    const NodeMatrix node = is_learnt ? solution().newest_node_covariance() : NodeMatrix(NodeMatrix::Zero());
    const Eigen::Matrix2d expected =
        by_calibration * estimate_.calibration.covariance.topLeftCorner<5, 5>() * by_calibration.transpose() +
        by_drift * node * by_drift.transpose();
    EXPECT_LT((row * row.transpose() - expected).norm(), 1e-12);
    EXPECT_EQ((row.rightCols<SharedError::kSize - SharedError::kFrame>().norm()), 0.0);
  }
}

TEST_F(SharedErrors, ThatAreExactlyKnownAreNoReasonToFail) {
  CalibrationPrior prior;
  prior.sigma_latency_s = prior.sigma_height_m = 0.0;
  const ArrowheadSolver solver(prior, 10);
  const SharedErrorEstimate estimate(accuracy_, DriftConfig{}, solver);
  EXPECT_TRUE(estimate.calibration_root.allFinite());
  EXPECT_TRUE(estimate.drift_root.allFinite());
}

}  // namespace
}  // namespace geoloc
