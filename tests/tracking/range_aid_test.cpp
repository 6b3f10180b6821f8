// SPDX-License-Identifier: Apache-2.0
#include "tracking/range_aid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calibration/noise.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "support/tilted_ground.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

const LocalFrame kHillFrame({46.05, 7.03});

VehicleState vehicle_at(const Eigen::Vector3d& reported, const EulerAngles& attitude) {
  VehicleState vehicle;
  vehicle.enu_from_body = {enu_from_ned() * ned_from_body(attitude), reported};
  return vehicle;
}

/// Reported to be 20 m above level ground at 1.5 m, and 23 m above it by the beam.
TEST(HeightReadings, OfLevelGroundAreTheBeamsHeightLessTheReportedOne) {
  const auto reading = height_reading(23.0, vehicle_at({5.0, 6.0, 21.5}, {}), 1.5, GroundModel(0.5));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->value_m, 3.0, 1e-9);
  EXPECT_NEAR(reading->variance_m2, 0.1 * 0.1 + std::pow(0.03 * 23.0, 2) + 0.5 * 0.5, 1e-9);
}

TEST(HeightReadings, AreCorrectedForTheTilt) {
  const double roll = 0.2, pitch = -0.15, height_m = 20.0;
  const double length_m = height_m / (std::cos(roll) * std::cos(pitch));
  const auto reading =
      height_reading(length_m, vehicle_at({0, 0, height_m}, {roll, pitch, 1.1}), 0.0, GroundModel(0.5));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->value_m, 0.0, 1e-9);
}

/// On a hillside the beam of a tilted vehicle ends higher or lower than the ground below it.
TEST(HeightReadings, CountFromWhereTheBeamEnds) {
  const Eigen::Vector2d slope(0.4, -0.1);
  const GroundModel hillside(testing::tilted_ground(kHillFrame, slope), kHillFrame, 0.5);
  const VehicleState vehicle = vehicle_at({10.0, -20.0, 40.0}, {0.2, 0.1, 2.0});
  const Eigen::Vector3d down = vehicle.enu_from_body.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d normal(-slope.x(), -slope.y(), 1.0);
  const double length_m = -normal.dot(vehicle.enu_from_body.translation) / normal.dot(down);
  const auto reading = height_reading(length_m, vehicle, 0.0, hillside);
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->value_m, 0.0, 1e-2);
}

TEST(HeightReadings, OfAVehicleThatTiltsFarOrOfItsLegsAreNone) {
  EXPECT_FALSE(height_reading(20.0, vehicle_at({0, 0, 20}, {0.8, 0.0, 0.0}), 0.0, GroundModel(0.5)));
  EXPECT_FALSE(height_reading(0.4, vehicle_at({0, 0, 20}, {}), 0.0, GroundModel(0.5)));
  EXPECT_FALSE(height_reading(std::nan(""), vehicle_at({0, 0, 20}, {}), 0.0, GroundModel(0.5)));
}

class Agreement : public ::testing::Test {
 protected:
  Agreement() { span_ = errors_.drift.cover(VehicleTime{}, 0.5); }

  void know_height(double height_m, double sigma_m) {
    errors_.calibration.mean[CalibrationIndex::kHeight] = height_m;
    errors_.calibration.covariance(CalibrationIndex::kHeight, CalibrationIndex::kHeight) = sigma_m * sigma_m;
  }

  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  NodeSpan span_;
};

TEST_F(Agreement, IsAskedForOnceLooksTellTheHeight) {
  EXPECT_TRUE(agrees({40.0, 1.0}, errors_, span_));
  know_height(2.0, 0.3);
  EXPECT_FALSE(agrees({40.0, 1.0}, errors_, span_));
}

TEST_F(Agreement, EndsAtFourSigma) {
  know_height(2.0, 0.3);
  const double sigma_m = std::hypot(1.0, 0.3);
  EXPECT_TRUE(agrees({2.0 + 3.9 * sigma_m, 1.0}, errors_, span_));
  EXPECT_FALSE(agrees({2.0 + 4.1 * sigma_m, 1.0}, errors_, span_));
  EXPECT_FALSE(agrees({2.0 - 4.1 * sigma_m, 1.0}, errors_, span_));
  EXPECT_FALSE(agrees({std::nan(""), 1.0}, errors_, span_));
}

/// The up component of the drift is a part of what is expected.
TEST_F(Agreement, FollowsTheDrift) {
  know_height(2.0, 0.0);
  errors_.drift.node(span_.first).mean[kNodeUp] = 5.0;
  EXPECT_TRUE(agrees({7.0, 0.01}, errors_, span_));
  EXPECT_FALSE(agrees({2.0, 0.01}, errors_, span_));
}

}  // namespace
}  // namespace geoloc
