// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// A confirmed object, as a camera that tracks it reports it.
struct CameraTarget {
  std::uint64_t id = 0;
  Geodetic position;
  double sigma_horizontal_m = 0.0;  ///< along the major axis
  std::optional<double> height_msl_m;
  std::optional<double> sigma_height_m;
  double distance_m = 0.0;  ///< from the camera
  /// Where it is in the image, 0..1 from its left and top edge; nullopt where it is not in the image.
  std::optional<Eigen::Vector2d> image_point;
};

/// The camera's last view.
struct CameraView {
  HostTime captured_at;
  VehicleTime time;
  Geodetic camera;
  std::optional<double> camera_height_msl_m;  ///< nullopt where the autopilot tells none
  std::optional<Geodetic> image_centre;       ///< on the ground; nullopt where it is not
  std::optional<double> ground_height_msl_m;
  std::optional<Eigen::Vector2d> focal_px;  ///< [fx, fy] then; nullopt: the calibration's
  Eigen::Quaterniond ned_from_camera = Eigen::Quaterniond::Identity();  ///< camera: forward, right, down
  std::vector<CameraTarget> targets;
};

}  // namespace geoloc::io
