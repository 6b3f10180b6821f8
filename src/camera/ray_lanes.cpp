// SPDX-License-Identifier: Apache-2.0
#include "camera/ray_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "camera/distortion.hpp"

namespace geoloc {
namespace {

/// Points that the lens shows at given ones.
struct Undistorted {
  Lanes x, y;
  Distorted<Lanes> there;
  Lanes error;  ///< of what the lens makes of them; they are found where it is below the tolerance
  Lanes is_lost = Lanes::Zero();  ///< 1 where the search could not go on, whatever it finds then
};

/// Newton for all at once. Those that are found stay. Without branches, so that it is done by vectors.
Undistorted undistort(const Lanes& distorted_x, const Lanes& distorted_y,
                      const DistortionCoefficients& coefficients) {
  Undistorted found;
  found.x = distorted_x;
  found.y = distorted_y;
  for (int step = 0; step < Undistortion::kMaxSteps; ++step) {
    found.there = distort<Lanes>(found.x, found.y, coefficients);
    const auto& there = found.there;
    const Lanes residual_x = distorted_x - there.x, residual_y = distorted_y - there.y;
    found.error = residual_x.abs().max(residual_y.abs());
    const Lanes determinant = there.x_by_x * there.y_by_y - there.x_by_y * there.x_by_y;
    const Lanes inverse = 1.0 / determinant;
    const Lanes next_x =
        found.x + (there.y_by_y * inverse * residual_x - there.x_by_y * inverse * residual_y);
    const Lanes next_y =
        found.y + (there.x_by_x * inverse * residual_y - there.x_by_y * inverse * residual_x);
    double most = 0.0;
    for (int i = 0; i < kLanes; ++i) {
      const bool stays = found.error[i] < Undistortion::kTolerance;
      const bool leads_on = std::abs(determinant[i]) > Undistortion::kLeastDeterminant;
      found.x[i] = stays ? found.x[i] : next_x[i];
      found.y[i] = stays ? found.y[i] : next_y[i];
      found.is_lost[i] = stays || leads_on ? found.is_lost[i] : 1.0;
    }
    for (int i = 0; i < kLanes; ++i) most = std::max(most, found.is_lost[i] > 0.0 ? 0.0 : found.error[i]);
    if (most < Undistortion::kTolerance) break;
  }
  return found;
}

}  // namespace

RayLanes ray_lanes(const Lanes& u_px, const Lanes& v_px, const CameraModel& camera) {
  const CameraIntrinsics& intrinsics = camera.intrinsics();
  const Lanes distorted_x = (u_px - intrinsics.cx_px) / intrinsics.fx_px;
  const Lanes distorted_y = (v_px - intrinsics.cy_px) / intrinsics.fy_px;
  const Undistorted found = undistort(distorted_x, distorted_y, intrinsics.distortion);
  const auto& there = found.there;
  const Lanes inverse = 1.0 / (there.x_by_x * there.y_by_y - there.x_by_y * there.x_by_y);
  RayLanes rays{found.x,
                found.y,
                there.y_by_y * inverse / intrinsics.fx_px,
                -there.x_by_y * inverse / intrinsics.fy_px,
                -there.x_by_y * inverse / intrinsics.fx_px,
                there.x_by_x * inverse / intrinsics.fy_px,
                {}};
  const Lanes radius_squared = found.x * found.x + found.y * found.y;
  for (int i = 0; i < kLanes; ++i)
    rays.is_ray[i] = found.error[i] < Undistortion::kTolerance && !(found.is_lost[i] > 0.0) &&
                     radius_squared[i] <= camera.max_radius_squared();
  return rays;
}

}  // namespace geoloc
