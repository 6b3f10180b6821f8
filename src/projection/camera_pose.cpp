// SPDX-License-Identifier: Apache-2.0
#include "projection/camera_pose.hpp"

#include <algorithm>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"

namespace geoloc {
namespace {

/// Eq. 6 as printed, for any mount.
Eigen::Quaterniond enu_from_camera_by_added_angles(const Eigen::Quaterniond& enu_from_body,
                                                   const CameraMount& mount) {
  const EulerAngles vehicle = euler_angles(enu_from_ned() * enu_from_body);
  const EulerAngles carrier{vehicle.roll_rad + mount.roll_deg * kRadPerDeg,
                            vehicle.pitch_rad + mount.pitch_deg * kRadPerDeg,
                            vehicle.yaw_rad + mount.yaw_deg * kRadPerDeg};
  return enu_from_ned() * ned_from_body(carrier) * body_from_forward_camera();
}

}  // namespace

Rigid3d enu_from_camera(const VehicleState& state, const CameraMount& mount, CameraOrientation orientation) {
  Rigid3d pose = state.enu_from_body * body_from_camera(mount);
  if (orientation == CameraOrientation::kAddedAngles) {
    pose.rotation = enu_from_camera_by_added_angles(state.enu_from_body.rotation, mount).normalized();
  }
  return pose;
}

Rigid3d enu_from_camera(const VehicleState& state, const GimbalState& gimbal, const CameraMount& mount) {
  const Rigid3d gimbal_from_camera = body_from_camera(mount);
  return {(gimbal.enu_from_gimbal * gimbal_from_camera.rotation).normalized(),
          state.enu_from_body * gimbal_from_camera.translation};
}

CameraTurn turn_of(const VehicleState& state) {
  return {state.enu_from_body.rotation * state.angular_velocity_in_body, state.sigma_turn_rad,
          state.sigma_bend_rad, state.telemetry_gap};
}

CameraTurn turn_of(const VehicleState& state, const GimbalState& gimbal) {
  return {gimbal.turn_rate_in_enu, gimbal.sigma_turn_rad, gimbal.sigma_bend_rad,
          std::max(state.telemetry_gap, gimbal.gap)};
}

}  // namespace geoloc
