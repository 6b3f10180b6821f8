// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "ground.hpp"
#include "ground_grid.hpp"
#include "light.hpp"

namespace geoloc::sim {

/// Paints ground and sky. Colour and light vary slowly and are computed at the grid's nodes; the grain is
/// looked up at every pixel, in the mip level that fits its footprint.
class GroundPainter {
 public:
  explicit GroundPainter(const GroundGrid& grid);

  /// image: CV_8UC3 of the camera's size.
  void paint(const GroundGrid& grid, const Ground& ground, const Light& light, cv::Mat& image);

 private:
  void locate_patches(const GroundGrid& grid, const MipAtlas& patches);
  void light_patches(const GroundGrid& grid, const Light& light);
  void locate_grain(const GroundGrid& grid, const MipAtlas& grain);

  struct RemapTable {
    cv::Mat whole;     // CV_16SC2
    cv::Mat fraction;  // CV_16UC1
  };
  RemapTable patches_at_;  // a node
  RemapTable grain_at_;    // a pixel of all cells
  cv::Mat patches_;        // CV_8UC3, a node
  cv::Mat base_;           // CV_8UC3, the patches enlarged
  cv::Mat grain_;          // CV_8UC3
};

}  // namespace geoloc::sim
