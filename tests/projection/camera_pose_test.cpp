// SPDX-License-Identifier: Apache-2.0
#include "projection/camera_pose.hpp"

#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"

namespace geoloc {
namespace {

VehicleState flying(double roll_deg, double pitch_deg, double yaw_deg) {
  VehicleState state{};
  state.enu_from_body.rotation =
      enu_from_ned() * ned_from_body({roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg});
  state.enu_from_body.translation = {0, 0, 20};
  return state;
}

/// Where the image's centre meets the ground from 20 m.
Eigen::Vector2d centre_on_ground(const VehicleState& state, CameraOrientation orientation) {
  const Projector projector({}, CameraIntrinsics{});
  return projector.project({639.5, 359.5}, enu_from_camera(state, CameraMount{}, orientation))
      ->position_in_enu;
}

TEST(CameraPose, ComposedLooksWhereTheTiltedVehicleLooks) {
  const Eigen::Vector2d centre = centre_on_ground(flying(10, 0, 0), CameraOrientation::kComposed);
  EXPECT_NEAR(centre.x(), -20.0 * std::tan(10 * kRadPerDeg), 1e-9);  // right wing down: looks to the left
  EXPECT_NEAR(centre.y(), 0.0, 1e-9);
}

TEST(CameraPose, AddedAnglesAreRightInLevelFlightAndInPitch) {
  for (const auto& state : {flying(0, 0, 130), flying(0, -15, 40)}) {
    const Eigen::Vector2d difference = centre_on_ground(state, CameraOrientation::kComposed) -
                                       centre_on_ground(state, CameraOrientation::kAddedAngles);
    EXPECT_LT(difference.norm(), 1e-6);
  }
}

// The figures of docs/method.md: eq. 6 turns the image about the optical axis where the vehicle rolls.
TEST(CameraPose, AddedAnglesMissTheRollEntirely) {
  for (const auto& [roll_deg, error_m] : {std::pair{10.0, 3.53}, {20.0, 7.28}}) {
    const VehicleState state = flying(roll_deg, 0, 0);
    const Eigen::Vector2d difference = centre_on_ground(state, CameraOrientation::kComposed) -
                                       centre_on_ground(state, CameraOrientation::kAddedAngles);
    EXPECT_NEAR(difference.norm(), error_m, 0.005);
  }
}

TEST(CameraPose, LeverArmTurnsWithTheVehicle) {
  const CameraMount mount{0, -90, 0, 1.0, 0.0, 0.5};
  const Rigid3d pose = enu_from_camera(flying(0, 0, 90), mount, CameraOrientation::kComposed);
  EXPECT_TRUE(pose.translation.isApprox(Eigen::Vector3d(1.0, 0.0, 19.5), 1e-12));  // nose to the east
}

}  // namespace
}  // namespace geoloc
