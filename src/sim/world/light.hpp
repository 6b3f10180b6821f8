// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "geoloc/sim/world/camera_renderer.hpp"
#include "ground_grid.hpp"

namespace geoloc::sim {

/// What stands between a surface and the sensor: illumination, haze, the lens' fall-off, exposure.
class Light {
 public:
  Light(const GroundGrid& grid, const cv::Size& image, const RenderSettings& settings);

  /// Grey levels (blue, green, red) of a surface of this reflectance (0..1) in the direction of the node.
  Eigen::Array3f seen(const Eigen::Array3f& reflectance, const GroundGrid& grid, int column, int row) const;

  /// The same of the sky in a direction that meets no ground.
  Eigen::Array3f sky(const GroundGrid& grid, int column, int row) const;

 private:
  std::vector<float> fall_off_;  // a node
  Eigen::Array3f gain_;
  float visibility_m_;
};

}  // namespace geoloc::sim
