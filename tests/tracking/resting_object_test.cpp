// SPDX-License-Identifier: Apache-2.0
#include "tracking/resting_object.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

class RestingObjectSums : public ::testing::Test {
 protected:
  Look look_at(double time_s) {
    Look look = testing::lone_look({3.0, -2.0}, 0.04);
    look.observation.span = errors_.drift.cover(VehicleTime{from_seconds(time_s)}, 0.5);
    const auto fill = [&](auto&& matrix) {
      for (double& value : matrix.reshaped()) value = normal_(random_);
    };
    fill(look.observation.calibration_jacobian);
    fill(look.observation.node_jacobian);
    fill(look.jacobian);
    look.pixel_noise << 0.04, 0.01, 0.01, 0.09;
    look.observation.information = (2.0 * look.pixel_noise).inverse();
    return look;
  }

  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}.max_nodes};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02}, DriftConfig{}, solver_};
  TrackTable tracks_{4};
};

TEST_F(RestingObjectSums, OfOneLookAreThatLook) {
  RestingObject& object = tracks_.append();
  object.landmark->add_prior({50.0, 50.0}, Eigen::Matrix2d::Identity());  // of a former object
  object.mixture.looks = 3;
  object.pixel_information.setConstant(7.0);
  const Look look = look_at(1.0);
  begin_sums(object, look, errors_);
  EXPECT_LT((object.track.position_in_enu.mean - Eigen::Vector2d(3.0, -2.0)).norm(), 1e-9);
  const Eigen::Matrix2d covariance = look.pixel_noise + look.jacobian * look.jacobian.transpose();
  EXPECT_LT((object.track.position_in_enu.covariance - covariance).norm(), 1e-12);
  EXPECT_LT((object.own_covariance - 2.0 * look.pixel_noise).norm(), 1e-12);
  EXPECT_LT((object.pixel_information.inverse() - look.pixel_noise).norm(), 1e-12);
  EXPECT_EQ(object.mixture.looks, 0);
}

TEST_F(RestingObjectSums, CountTheDetectorsInformationOfEachLook) {
  RestingObject& object = tracks_.append();
  begin_sums(object, look_at(1.0), errors_);
  for (int i = 0; i < 3; ++i) add_to_sums(object, look_at(1.1 + 0.1 * i), errors_);
  EXPECT_LT((object.pixel_information.inverse() - look_at(2.0).pixel_noise / 4.0).norm(), 1e-12);
  EXPECT_LT((object.own_covariance - 2.0 * look_at(2.0).pixel_noise / 4.0).norm(), 1e-12);
}

/// The sensitivity is how the position moves with calibration and the present drift, in units of their
/// sigmas: by finite differences.
TEST_F(RestingObjectSums, MoveWithTheSharedErrors) {
  RestingObject& object = tracks_.append();
  begin_sums(object, look_at(0.0), errors_);
  for (int i = 1; i < 30; ++i) add_to_sums(object, look_at(0.5 * i), errors_);
  errors_.take(*solver_.solve({object.landmark}, errors_.offset_sigma_m(), errors_.drift));
  const NodeSpan now = errors_.drift.cover(VehicleTime{from_seconds(14.8)}, 0.5);
  refresh(object, errors_, now);
  const Eigen::Vector2d before = object.track.position_in_enu.mean;
  EXPECT_LT((before - object.landmark->position(errors_.calibration.mean, errors_.drift)).norm(), 1e-12);
  constexpr double kStep = 1e-3;
  for (int i = 0; i < SharedError::kCalibrationSize; ++i) {
    CalibrationVector moved = errors_.calibration.mean;
    moved.head<SharedError::kCalibrationSize>() += kStep * errors_.calibration_root.col(i);
    const Eigen::Vector2d slope = (object.landmark->position(moved, errors_.drift) - before) / kStep;
    EXPECT_LT((object.sensitivity.col(SharedError::kCalibration + i) - slope).norm(), 1e-6);
  }
  for (int i = 0; i < kNodeSize; ++i) {
    DriftTimeline moved = errors_.drift;
    for (const std::uint32_t number : {now.first, now.first + 1})
      moved.node(number).mean += kStep * errors_.drift_root.col(i);
    const Eigen::Vector2d slope =
        (object.landmark->position(errors_.calibration.mean, moved) - before) / kStep;
    EXPECT_LT((object.sensitivity.col(SharedError::kDrift + i) - slope).norm(), 1e-6);
    EXPECT_GT(slope.norm(), 1e-6);
  }
}

}  // namespace
}  // namespace geoloc
