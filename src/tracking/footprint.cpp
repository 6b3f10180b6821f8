// SPDX-License-Identifier: Apache-2.0
#include "tracking/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

/// The plane ends in a circle, which reaches farther out between rays than at them.
constexpr double kBetweenRays = 1.05;

/// East and north per metre down of a ray: no farther than fixes reach from `height_m`.
Eigen::Vector2d per_metre_down(const Eigen::Vector3d& direction, double height_m,
                               const ProjectorConfig& config) {
  const double steepest = kBetweenRays / std::tan(config.min_depression_deg * kRadPerDeg);
  const double farthest = std::min(steepest, kBetweenRays * config.max_range_m / std::max(height_m, 1e-3));
  const Eigen::Vector2d along = direction.head<2>();
  const double length = along.norm();
  if (!(length > 0.0)) return Eigen::Vector2d::Zero();
  const double slope = direction.z() < 0.0 ? std::min(length / -direction.z(), farthest) : farthest;
  return along * (slope / length);
}

}  // namespace

/// By a camera without distortion; lenses bend the border by less than what the box has to spare around it.
Eigen::AlignedBox2d footprint(const Projector& projector, const FrameView& view, double up_m) {
  constexpr double kBeyondBorder = 0.1;  // of the image's half width and height
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  const Eigen::Vector2d focal_px = projector.focal_px(view);
  const Eigen::Vector3d& origin = view.enu_from_camera.translation;
  const Eigen::Matrix3d rotation = view.enu_from_camera.rotation.toRotationMatrix();
  const double height_m = std::max(0.0, origin.z() - projector.config().ground_height_above_home_m);
  Eigen::AlignedBox2d box;
  for (const double across : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    for (const double down : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const double u = 0.5 * camera.width_px * (1.0 + (1.0 + kBeyondBorder) * across);
      const double v = 0.5 * camera.height_px * (1.0 + (1.0 + kBeyondBorder) * down);
      const Eigen::Vector3d ray((u - camera.cx_px) / focal_px.x(), (v - camera.cy_px) / focal_px.y(), 1.0);
      const Eigen::Vector2d slope = per_metre_down(rotation * ray, height_m, projector.config());
      box.extend(origin.head<2>() + (height_m + up_m) * slope);
      box.extend(origin.head<2>() + std::max(0.0, height_m - up_m) * slope);
    }
  }
  return box;
}

}  // namespace geoloc
