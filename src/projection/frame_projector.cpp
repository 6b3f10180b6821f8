// SPDX-License-Identifier: Apache-2.0
#include "projection/frame_projector.hpp"

#include <cmath>

#include "camera/ray_lanes.hpp"

namespace geoloc {

FrameProjector::FrameProjector(const Projector& projector, const Rigid3d& enu_from_camera)
    : projector_(projector),
      camera_(projector.camera()),
      camera_in_enu_(enu_from_camera.translation),
      enu_from_camera_(enu_from_camera.rotation.toRotationMatrix()),
      is_finite_(enu_from_camera.translation.allFinite() && enu_from_camera.rotation.coeffs().allFinite()) {}

FrameProjector::FrameProjector(const Projector& projector, const FrameView& from)
    : FrameProjector(projector, from.enu_from_camera) {
  if (Projector::is_zoomed(from)) camera_ = camera_.with_focal_length(projector.focal_px(from));
}

/// As Projector has it for one pixel: ground_from_normalized() of a level plane is written out.
FrameProjector::Fixes FrameProjector::fixes_of(const Lanes& u_px, const Lanes& v_px) const {
  const RayLanes rays = ray_lanes(u_px, v_px, camera_);
  const Eigen::Matrix3d& r = enu_from_camera_;
  const Lanes x = r(0, 0) * rays.x + r(0, 1) * rays.y + r(0, 2);
  const Lanes y = r(1, 0) * rays.x + r(1, 1) * rays.y + r(1, 2);
  const Lanes z = r(2, 0) * rays.x + r(2, 1) * rays.y + r(2, 2);
  const Lanes length = (x * x + y * y + z * z).sqrt();

  Fixes fixes;
  fixes.direction_east = x / length;
  fixes.direction_north = y / length;
  fixes.direction_up = z / length;
  fixes.range_m = (projector_.config().ground_height_above_home_m - camera_in_enu_.z()) / fixes.direction_up;
  for (int i = 0; i < kLanes; ++i) {
    if (!is_finite_ || !std::isfinite(u_px[i]) || !std::isfinite(v_px[i])) {
      fixes.none[i] = NoFix::kNotFinite;
    } else if (!rays.is_ray[i]) {
      fixes.none[i] = NoFix::kNoRay;
    } else {
      fixes.none[i] = projector_.why_none(camera_in_enu_.z(), fixes.direction_up[i], fixes.range_m[i]);
    }
  }
  fixes.east = camera_in_enu_.x() + fixes.range_m * fixes.direction_east;
  fixes.north = camera_in_enu_.y() + fixes.range_m * fixes.direction_north;

  const Lanes scale = fixes.range_m / length;
  const Lanes slant_east = scale * -(x / z), slant_north = scale * -(y / z);
  const Lanes east_by_x = scale * r(0, 0) + slant_east * r(2, 0);
  const Lanes east_by_y = scale * r(0, 1) + slant_east * r(2, 1);
  const Lanes north_by_x = scale * r(1, 0) + slant_north * r(2, 0);
  const Lanes north_by_y = scale * r(1, 1) + slant_north * r(2, 1);
  fixes.east_by_u = east_by_x * rays.x_by_u + east_by_y * rays.y_by_u;
  fixes.east_by_v = east_by_x * rays.x_by_v + east_by_y * rays.y_by_v;
  fixes.north_by_u = north_by_x * rays.x_by_u + north_by_y * rays.y_by_u;
  fixes.north_by_v = north_by_x * rays.x_by_v + north_by_y * rays.y_by_v;
  return fixes;
}

Expected<GroundFix, NoFix> FrameProjector::Fixes::of(int lane) const {
  if (none[lane]) return *none[lane];
  GroundFix fix;
  fix.position_in_enu << east[lane], north[lane];
  fix.ground_from_pixel << east_by_u[lane], east_by_v[lane], north_by_u[lane], north_by_v[lane];
  fix.direction_in_enu << direction_east[lane], direction_north[lane], direction_up[lane];
  fix.range_m = range_m[lane];
  return fix;
}

}  // namespace geoloc
