// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/camera_sight.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::io {
namespace {

/// The view's axis is that near to the vertical: its direction on the ground is none.
constexpr double kVertical = 1e-3;

/// Level, and where the camera looks to: an axis that is nearly vertical leaves that to the image's top.
Eigen::Vector2d heading(const Eigen::Vector3d& forward, const Eigen::Vector3d& down) {
  if (forward.head<2>().norm() > kVertical) return forward.head<2>().normalized();
  return (forward.z() < 0.0 ? -down : down).head<2>().normalized();
}

}  // namespace

CameraSight sight_of(const Eigen::Quaterniond& enu_from_camera, double convergence_rad) {
  const Eigen::Matrix3d axes = enu_from_camera.toRotationMatrix();
  const Eigen::Vector3d right = axes.col(0), down = axes.col(1), forward = axes.col(2);
  const Eigen::Vector2d ahead = heading(forward, down);
  const Eigen::Vector3d level_right(ahead.y(), -ahead.x(), 0.0);
  CameraSight sight;
  const double azimuth_deg = (std::atan2(ahead.x(), ahead.y()) - convergence_rad) * kDegPerRad;
  const double turned_deg = azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0);
  sight.azimuth_deg = turned_deg < 360.0 ? turned_deg : 0.0;  // of next to nothing below zero
  sight.elevation_deg = std::asin(std::clamp(forward.z(), -1.0, 1.0)) * kDegPerRad;
  sight.roll_deg = std::atan2(right.dot(forward.cross(level_right)), right.dot(level_right)) * kDegPerRad;
  return sight;
}

}  // namespace geoloc::io
