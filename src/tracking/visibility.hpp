// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/projector.hpp"

namespace geoloc {

/// An object where a frame would show it.
struct ShownObject {
  Eigen::Vector3d position_in_enu;  ///< corrections undone; up as in the camera's pose [m]
  double sigma_m = 0.0;             ///< of the position: square root of the covariance's trace
  double size_m = 0.0;
  std::optional<double> ground_per_pixel_m;  ///< at its place, where that is known already
};

/// How well a frame shows an object, 0..1, as a factor of the probability of its detection: 0 outside of the
/// image, at its edge and below smallest_object_px, 1 from twice that on. sigma_px: of a detection's centre.
double visibility(const ShownObject& object, const Projector& projector, const FrameView& view,
                  double sigma_px, double smallest_object_px);

}  // namespace geoloc
