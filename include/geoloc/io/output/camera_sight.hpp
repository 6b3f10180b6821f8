// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace geoloc::io {

/// Where a camera looks, and how far it sees to the sides.
struct CameraSight {
  double azimuth_deg = 0.0;    ///< of the view's axis from true north, clockwise, in [0, 360)
  double elevation_deg = 0.0;  ///< of the view's axis above the horizon: -90 straight down
  double roll_deg = 0.0;       ///< about the view's axis: positive where the right of the image is lower
  double horizontal_view_deg = 0.0;  ///< from edge to edge
  double vertical_view_deg = 0.0;
  std::optional<double> range_m;  ///< to the ground at the image's centre; nullopt where there is none
};

/// The angles of a camera (right, down, forward). Where it looks straight up or down, the azimuth is where
/// the image's top points, or its bottom: that of a camera that is tilted on. convergence_rad: grid north
/// minus true north (LocalPoint).
CameraSight sight_of(const Eigen::Quaterniond& enu_from_camera, double convergence_rad);

}  // namespace geoloc::io
