// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geoloc/camera/camera.hpp"
#include "geometry/lanes.hpp"

namespace geoloc {

/// Rays of several pixels (ImageRay).
struct RayLanes {
  Lanes x, y;            ///< normalized, without distortion, at unit depth
  Lanes x_by_u, x_by_v;  ///< d normalized / d pixel [1/px]
  Lanes y_by_u, y_by_v;
  std::array<bool, kLanes> is_ray;  ///< elsewhere the rest says nothing
};

/// Number for number what CameraModel::ray() gives for each of the pixels (u, v).
RayLanes ray_lanes(const Lanes& u_px, const Lanes& v_px, const CameraModel& camera);

}  // namespace geoloc
