// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/ray_plane.hpp"

namespace geoloc::sim {

/// Where the pixel's line of sight meets the plane z = 0 of ENU [m]; nullopt where it does not.
inline std::optional<Eigen::Vector3d> ground_point(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                                   const Eigen::Vector2d& pixel) {
  const auto ray = camera.ray(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector3d direction = enu_from_camera.rotation * ray->normalized.homogeneous().normalized();
  const Ray<double> sight{enu_from_camera.translation, direction};
  const auto range_m = intersect(sight, Plane<double>{Eigen::Vector3d::UnitZ(), 0.0});
  if (!range_m) return std::nullopt;
  return sight.at(*range_m);
}

}  // namespace geoloc::sim
