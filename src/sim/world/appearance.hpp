// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

/// What one point of an object looks like in full light.
struct Surface {
  Eigen::Array3f reflectance;  ///< blue, green, red in 0..1, as displayed (gamma-encoded)
  float coverage;              ///< 0 where the ground shows, 1 where the object hides it
};

/// Half the length and half the width [m] of the rectangle outside which the object is nowhere.
Eigen::Vector2f half_extent_m(const PlacedObject& object);

/// The object's look at a point of its own axes, forward and right of its centre [m]; exact at any scale.
Surface surface_at(const PlacedObject& object, const Eigen::Vector2f& point_in_object_m);

/// Factor (0.84..1) on the reflectance there, for dirt and wear in blotches a sixth of the object wide.
float wear_at(const PlacedObject& object, const Eigen::Vector2f& point_in_object_m);

/// Rotation that takes east-north coordinates, relative to the object's centre, to its forward-right axes.
Eigen::Matrix2d object_from_enu(const PlacedObject& object);

}  // namespace geoloc::sim
