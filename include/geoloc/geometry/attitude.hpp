// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace geoloc {

/// Aerospace (Z-Y'-X'') angles of the body, forward-right-down, against the local north-east-down axes [rad].
struct EulerAngles {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;  ///< from true north, clockwise
};

/// Rotation that takes a vector from body (forward-right-down) to local north-east-down axes.
Eigen::Quaterniond ned_from_body(const EulerAngles& angles);

/// Rotation that takes a vector from local north-east-down to east-north-up axes. It is its own inverse.
Eigen::Quaterniond enu_from_ned();

/// Inverse of ned_from_body(). At pitch = +-90 deg roll is reported as 0.
EulerAngles euler_angles(const Eigen::Quaterniond& ned_from_body);

}  // namespace geoloc
