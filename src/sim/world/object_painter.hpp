// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "geoloc/sim/world/scene.hpp"
#include "ground_grid.hpp"
#include "light.hpp"

namespace geoloc::sim {

/// Paints the object where it lies on the ground, each pixel the mean over its area.
/// image: CV_8UC3 of the camera's size, the ground already in it.
void paint_object(const GroundGrid& grid, const Light& light, const PlacedObject& object, cv::Mat& image);

}  // namespace geoloc::sim
