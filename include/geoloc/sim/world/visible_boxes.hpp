// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

/// A target as an ideal detector would box it.
struct VisibleBox {
  std::size_t object_index;  ///< in the given list
  Box whole;                 ///< around the outline, also where that leaves the image
  Box box;                   ///< the part of `whole` inside the image
  double visible_fraction;   ///< area of box / area of whole, in (0, 1]
  Eigen::Vector2d
      centre_px;  ///< projection of the target's centre, which whole.centre() misses by some 0.01 of its size
};

/// Box of objects[index], of whatever kind; nullopt where the camera sees nothing of it.
std::optional<VisibleBox> visible_box(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                      const std::vector<PlacedObject>& objects, std::size_t index);

/// Boxes of all fiducial targets that the camera sees in part at least.
std::vector<VisibleBox> visible_boxes(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                      const std::vector<PlacedObject>& objects);

}  // namespace geoloc::sim
