// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/detection.hpp"

namespace geoloc::io {

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

/// Where a picture lies in a network's input: scaled to fit with its aspect ratio kept, centred between grey
/// bars, or stretched over it.
///
/// Boxes have continuous edges (camera/detection.hpp), and cv::resize keeps those: it samples the source at
/// (i + 1/2) * scale - 1/2 for the destination's pixel i, so the left edge 0 stays 0 and the right edge stays
/// the right edge. Hence coordinates of edges scale without the half pixels that coordinates of pixel centres
/// need.
struct Letterbox {
  int left_px = 0;  ///< of the scaled picture in the input
  int top_px = 0;
  ImageSize scaled;
  double scale_x = 1.0;  ///< input pixels per picture pixel; differs from scale_y by the rounding of `scaled`
  double scale_y = 1.0;

  Box to_input(const Box& in_picture) const;
  Box to_picture(const Box& in_input) const;
};

/// Both sizes must be positive. The scaled picture is at least one pixel wide and high.
Letterbox fit_letterbox(ImageSize picture, ImageSize input);

/// The picture fills the input, and its aspect ratio changes. Both sizes must be positive.
Letterbox stretch_to(ImageSize picture, ImageSize input);

}  // namespace geoloc::io
