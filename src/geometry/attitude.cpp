// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/attitude.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {

Eigen::Quaterniond ned_from_body(const EulerAngles& angles) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return AngleAxisd(angles.yaw_rad, Vector3d::UnitZ()) * AngleAxisd(angles.pitch_rad, Vector3d::UnitY()) *
         AngleAxisd(angles.roll_rad, Vector3d::UnitX());
}

Eigen::Quaterniond enu_from_ned() {
  // Half a turn about the axis between north and east: x and y change places, z changes sign.
  return {0.0, std::sqrt(0.5), std::sqrt(0.5), 0.0};
}

EulerAngles euler_angles(const Eigen::Quaterniond& ned_from_body) {
  const Eigen::Matrix3d r = ned_from_body.toRotationMatrix();
  const double pitch_sine = std::clamp(-r(2, 0), -1.0, 1.0);
  const double pitch_cosine = std::hypot(r(2, 1), r(2, 2));
  if (pitch_cosine < 1e-9) return {0.0, std::asin(pitch_sine), std::atan2(-r(0, 1), r(1, 1))};
  return {std::atan2(r(2, 1), r(2, 2)), std::atan2(pitch_sine, pitch_cosine), std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace geoloc
