// SPDX-License-Identifier: Apache-2.0
#include "projection/camera_pose.hpp"

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

}  // namespace geoloc
