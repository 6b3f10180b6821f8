// SPDX-License-Identifier: Apache-2.0
#include "calibration/shared_error_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "calibration/noise.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;

TEST(PositionAccuracy, DividesAmongTheAxesAndBetweenWhatStaysAndWhatWanders) {
  const PositionAccuracy accuracy{2.0, 0.25, 0.0, 0.1};
  const double wandering = accuracy.wandering_sigma_m(), offset = accuracy.offset_sigma_m(1.0);
  EXPECT_NEAR(2.0 * (wandering * wandering + offset * offset), 4.0, 1e-12);  // the radius' square
  EXPECT_NEAR(offset * offset / (wandering * wandering), 0.25 / 0.75, 1e-12);
}

TEST(PositionAccuracy, OfAReceiverThatWandersLessIsBetterButForAFloor) {
  const PositionAccuracy accuracy{2.0, 0.25, 0.0, 0.1};
  EXPECT_NEAR(accuracy.offset_sigma_m(0.5), 0.5 * accuracy.offset_sigma_m(1.0), 1e-12);
  EXPECT_NEAR(accuracy.offset_sigma_m(2.0), 2.0 * accuracy.offset_sigma_m(1.0), 1e-12);
  EXPECT_EQ(accuracy.offset_sigma_m(0.01), 0.1);
}

TEST(PositionAccuracy, OfAFixThatStatesNextToNothingIsNotBelievedUntilTheFlightShowsIt) {
  const PositionAccuracy rtk{0.02, 0.15, 0.04, 0.02};
  EXPECT_EQ(rtk.offset_sigma_m(1.0), 0.04);
  EXPECT_NEAR(rtk.offset_sigma_m(0.8), 0.032, 1e-12);
  EXPECT_EQ(rtk.offset_sigma_m(0.1), 0.02);
}

TEST(PositionAccuracy, ThatIsReportedIsBelievedToBeWrongByAFactorAtMost) {
  PositionAccuracy accuracy{2.0, 0.25, 0.1, 0.1};
  accuracy.report(0.5);
  EXPECT_EQ(accuracy.radial_m, 0.5);
  EXPECT_EQ(accuracy.believed_scale(0.5), 0.5);
  EXPECT_EQ(accuracy.believed_scale(0.01), 0.1);
  EXPECT_EQ(accuracy.believed_scale(7.0), 3.0);
}

/// Whatever was assumed, the flight may show that the vehicle is as good as the best that report themselves.
TEST(PositionAccuracy, ThatIsAssumedDoesNotKeepAFlightFromShowingABetterOne) {
  PositionAccuracy best{1.0, 0.25, 0.1, 0.1};
  best.report(1e-6);
  for (const double assumed_m : {0.3, 0.85, 2.0}) {
    const PositionAccuracy accuracy{assumed_m, 0.25, 0.1, 0.1};
    EXPECT_NEAR(accuracy.believed_scale(1e-6) * accuracy.wandering_sigma_m(), best.wandering_sigma_m(), 1e-9);
    EXPECT_EQ(accuracy.believed_scale(0.5), 0.5);
    EXPECT_EQ(accuracy.believed_scale(7.0), 3.0);
  }
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
    SwayTimeline& sway = estimate_.drift.sway();
    sway.set_variance(0.3, 0.2);
    for (int i = 0; i < 60; ++i) {
      LandmarkObservation look;
      look.span = estimate_.drift.cover(VehicleTime{from_seconds(0.3 * i)}, 0.5);
      while (sway.is_full()) {
        for (Landmark& landmark : landmarks_) landmark.freeze_spell(sway.begin(), estimate_.drift);
        sway.freeze_oldest();
      }
      fill(look.calibration_jacobian);
      fill(look.node_jacobian);
      fill(look.value);
      fill(look.slope);
      look.information = 4.0 * Eigen::Matrix2d::Identity();
      landmarks_[i % 2].add(look, estimate_.drift);
    }
    estimate_.take(solution());
  }

  ArrowheadSolver::Solution solution() {
    return *solver_.solve({&landmarks_[0], &landmarks_[1]}, prior_, estimate_.drift);
  }

  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  PositionAccuracy accuracy_{1.0, 0.2, 0.02, 0.02};
  HeightPrior height_prior_{0.4, 1.5};
  SharedErrorEstimate estimate_{accuracy_, height_prior_, testing::kNoise, DriftConfig{}, solver_};
  FlightPrior prior_ = estimate_.prior();  // of every solution, so that all are the same
  Landmark landmarks_[2];
};

TEST_F(SharedErrors, BeginAsThePrior) {
  const Calibration prior = solver_.prior({0.4, height_prior_.sigma_at(0.4), accuracy_.offset_sigma_m(1.0)});
  EXPECT_EQ(estimate_.calibration.mean, prior.mean);
  EXPECT_EQ(estimate_.calibration.covariance, prior.covariance);
  EXPECT_EQ(estimate_.offset_sigma_m(), accuracy_.offset_sigma_m(1.0));
}

/// A component frozen by a sigma of 0 leaves the others' roots what they are.
TEST(FrozenSharedErrors, HaveARootBesideTheOthers) {
  CalibrationPrior prior;
  prior.sigma_boresight_y_deg = 0.0;
  const ArrowheadSolver solver(prior, DriftConfig{});
  const SharedErrorEstimate estimate({1.0, 0.2, 0.02, 0.02}, {0.0, 2.0}, testing::kNoise, DriftConfig{},
                                     solver);
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
  const SwayTimeline& sway = estimate_.drift.sway();
  ASSERT_EQ(sway.size(), DriftConfig{}.max_spells);
  for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
    EXPECT_EQ(sway.spell(number).mean, again.spell(number));
    EXPECT_GT(again.spell(number).norm(), 1e-3);
  }
}

TEST_F(SharedErrors, AreLessWhereThePositionWandersLess) {
  estimate_.drift.set_position_scale(0.5);
  EXPECT_NEAR(estimate_.offset_sigma_m(), accuracy_.offset_sigma_m(0.5), 1e-15);
}

/// A whitened Jacobian's square is the covariance that its errors cause; before and after learning.
TEST_F(SharedErrors, WhitenJacobians) {
  for (const bool is_learnt : {false, true}) {
    if (is_learnt) learn();
    Eigen::Matrix<double, 3, SharedError::kCalibrationSize> by_calibration;
    by_calibration << 1, -2, 3, 0.5, -1, 2.5, 1.1, 0.3, 2, -1, 4, 1.5, -3.5, -0.6, -0.7, 0.2, 1, -3, 2, 0.9,
        2.2;
    Eigen::Matrix<double, 3, kNodeSize> by_drift;
    for (int i = 0; i < kNodeSize; ++i) by_drift.col(i) << 1.0 - i, 0.3 * i, std::cos(i);
    const SharedError::PointRow row = estimate_.whitened<3>(by_calibration, by_drift);
    const NodeMatrix node = is_learnt ? solution().newest_node_covariance() : NodeMatrix(NodeMatrix::Zero());
    const Eigen::Matrix3d expected =
        by_calibration *
            estimate_.calibration.covariance
                .topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>() *
            by_calibration.transpose() +
        by_drift * node * by_drift.transpose();
    EXPECT_LT((row * row.transpose() - expected).norm(), 1e-12);
    EXPECT_EQ((row.rightCols<SharedError::kSize - SharedError::kFrame>().norm()), 0.0);
  }
}

TEST_F(SharedErrors, ThatAreExactlyKnownAreNoReasonToFail) {
  CalibrationPrior prior;
  prior.sigma_latency_s = prior.sigma_height_m = 0.0;
  const ArrowheadSolver solver(prior, DriftConfig{});
  SharedErrorEstimate estimate(accuracy_, {3.0, 0.0}, testing::kNoise, DriftConfig{}, solver);
  EXPECT_TRUE(estimate.calibration_root.allFinite());
  EXPECT_TRUE(estimate.drift_root.allFinite());
  EXPECT_NEAR(estimate.lift_m(30.0), 3.0, 1e-9);
  estimate.bound_height(30.0);
  EXPECT_TRUE(estimate.calibration_root.allFinite());
}

/// What the next solution is told: of the height, what the heavy tails say where it is believed to be now.
TEST_F(SharedErrors, TellTheNextSolutionWhatToExpect) {
  for (const double height_m : {0.4, 1.9, -30.0}) {
    estimate_.calibration.mean[Index::kHeight] = height_m;
    estimate_.drift.set_position_scale(0.6);
    const FlightPrior prior = estimate_.prior();
    EXPECT_EQ(prior.height_m, 0.4);
    EXPECT_NEAR(prior.sigma_height_m, std::sqrt((1.5 * 1.5 + std::pow(height_m - 0.4, 2)) / 2.0), 1e-12);
    EXPECT_NEAR(prior.sigma_offset_m, accuracy_.offset_sigma_m(0.6), 1e-12);
  }
}

/// An object's height above home is its height above the level ground less the camera's.
TEST_F(SharedErrors, TellHeightsAboveHomeFromThoseAboveTheLevelGround) {
  learn();
  const Eigen::Matrix<double, 3, SharedError::kCalibrationSize> by_calibration =
      Eigen::Matrix<double, 3, SharedError::kCalibrationSize>::Random();
  const Eigen::Matrix<double, 3, kNodeSize> by_drift = Eigen::Matrix<double, 3, kNodeSize>::Random();
  const SharedError::PointRow above_home =
      estimate_.above_home(estimate_.whitened<3>(by_calibration, by_drift));
  Eigen::Matrix<double, 3, SharedError::kCalibrationSize> less_height = by_calibration;
  less_height(2, Index::kHeight) -= 1.0;
  EXPECT_LT((above_home - estimate_.whitened<3>(less_height, by_drift)).norm(), 1e-12);
}

// --- How far the camera is lifted.

class Lift : public SharedErrors {
 protected:
  /// The height is known so much better than before the flight.
  void know_height(double height_m, double share_of_prior) {
    estimate_.calibration.mean[Index::kHeight] = height_m;
    const double sigma_m = share_of_prior * height_prior_.sigma_at(height_m);
    estimate_.calibration.covariance(Index::kHeight, Index::kHeight) = sigma_m * sigma_m;
  }
};

TEST_F(Lift, IsTheEstimateWhereThatLeavesTheCameraHighAboveTheGround) {
  for (const double height_m : {-7.0, 0.0, 12.0}) {
    know_height(height_m, 1.0);
    EXPECT_EQ(estimate_.lift_m(30.0), height_m);
  }
}

/// Ten metres while nothing is known, a quarter of that where half of the sigma is left, and half a metre at
/// the least.
TEST_F(Lift, LeavesTheCameraTheHigherAboveTheGroundTheLessIsKnown) {
  for (const double reported_m : {-20.0, 0.0, 1.0}) {
    for (const auto& [unknown, least_m] : {std::pair{1.0, 10.0}, {0.5, 2.5}, {0.1, 0.5}, {0.0, 0.5}}) {
      know_height(-2.0, unknown);
      EXPECT_NEAR(reported_m + estimate_.lift_m(reported_m), least_m, 1e-9);
    }
  }
}

TEST_F(Lift, HasNoStepWhereTheCameraComesNearTheGround) {
  know_height(-2.0, 0.5);
  for (const double reported_m : {4.5 - 1e-9, 4.5 + 1e-9})
    EXPECT_NEAR(estimate_.lift_m(reported_m), -2.0, 1e-8);
}

// --- How much of the height is taken to be unknown for telling looks apart.

class BoundedHeight : public SharedErrors {
 protected:
  /// Covariance that the roots stand for.
  Eigen::Matrix<double, SharedError::kCalibrationSize, SharedError::kCalibrationSize> covariance() const {
    return estimate_.calibration_root * estimate_.calibration_root.transpose();
  }
};

TEST_F(BoundedHeight, IsATwentiethOfTheCamerasHeightAtMost) {
  learn();
  const double sigma_m = estimate_.calibration.sigma(Index::kHeight);
  const auto unbounded = covariance();
  for (const double factor : {0.3, 0.9, 1.1, 10.0}) {
    estimate_.bound_height(factor * 20.0 * sigma_m);
    const double share = std::min(1.0, factor);
    auto expected = unbounded;  // correlations stay
    expected.row(Index::kHeight) *= share;
    expected.col(Index::kHeight) *= share;
    EXPECT_LT((covariance() - expected).norm(), 1e-12) << factor;
  }
}

TEST_F(BoundedHeight, IsThatAboveTheGroundOrBelowIt) {
  estimate_.bound_height(-2.0);
  EXPECT_NEAR(covariance()(Index::kHeight, Index::kHeight), 0.1 * 0.1, 1e-12);
}

TEST_F(BoundedHeight, LeavesWhatWasLearntAsItIs) {
  learn();
  const Calibration learnt = estimate_.calibration;
  estimate_.bound_height(0.1);
  EXPECT_EQ(estimate_.calibration.covariance, learnt.covariance);
  estimate_.take(solution());
  EXPECT_NEAR(covariance()(Index::kHeight, Index::kHeight),
              estimate_.calibration.covariance(Index::kHeight, Index::kHeight), 1e-12);
}

TEST_F(SharedErrors, AreLessWellKnownAfterAStepUntilTheNextSolution) {
  learn();
  const NodeMatrix before = estimate_.drift_root * estimate_.drift_root.transpose();
  const SharedError::CalibrationMatrix calibration = estimate_.calibration_root;
  const NodeVector step_variance(0.3, 0.2, 0.1, 0.02);
  estimate_.widen_drift(step_variance);
  const NodeMatrix added = estimate_.drift_root * estimate_.drift_root.transpose() - before;
  EXPECT_LT((added - NodeMatrix(step_variance.asDiagonal())).norm(), 1e-9);
  EXPECT_EQ(estimate_.calibration_root, calibration);
  estimate_.take(solution());
  EXPECT_LT((estimate_.drift_root * estimate_.drift_root.transpose() - before).norm(), 1e-9);
}

/// Frames far apart do not sway; in the opening the looks bear the noise.
TEST_F(SharedErrors, SwayAsTheFramesNoise) {
  const double attitude = estimate_.noise.attitude_variance_rad2(), position = 0.03;
  SwayVector noise;
  noise << position, position, attitude, attitude;
  estimate_.believe_in_sway(position, true);
  EXPECT_LT((estimate_.drift.sway().variance() - 0.1 * noise).norm(), 1e-12);
  estimate_.is_opening = false;
  estimate_.believe_in_sway(position, true);
  EXPECT_LT((estimate_.drift.sway().variance() - noise).norm(), 1e-12);
  estimate_.believe_in_sway(position, false);
  EXPECT_EQ(estimate_.drift.sway().variance().norm(), 0.0);
}

}  // namespace
}  // namespace geoloc
