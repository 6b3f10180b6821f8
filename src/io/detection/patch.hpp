// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "geoloc/camera/detection.hpp"

// Input and output of a second look; tools/train/patches.py does the same.
namespace geoloc::io {

/// The square around a box: its sides are twice the box's longer side, but at least 16 px and at most the
/// picture's shorter side. It is in whole pixels, and partly outside of the picture for a box near its edge.
cv::Rect patch_around(const Box& box, cv::Size picture);

/// That square of the picture (8 bits, BGR), `side_px` wide and high; beyond the picture's edge its outermost
/// pixels are repeated.
cv::Mat cut_patch(const cv::Mat& bgr, const cv::Rect& square, int side_px);

/// Writes a patch as planes of red, green and blue [3, side, side]: each has mean 0, and the brightness has
/// standard deviation 1, so that neither exposure nor white balance matters.
void write_normalised(const cv::Mat& patch, float* planes);

/// A row of the network's output. Lengths are in units of the square's side.
struct SecondLookAnswer {
  static constexpr int kValues = 6;

  explicit SecondLookAnswer(const float* values);

  double score;                       ///< 0..1: whether it is such an object
  double off_centre_x, off_centre_y;  ///< the object's centre, from that of the square
  double width, height;
  double sigma;  ///< per-axis 1-sigma of the centre

  /// Whether it is finite, has a size, and has a score in 0..1.
  bool is_sound() const;
  /// Whether the score is neither clearly positive nor clearly negative.
  bool is_in_doubt() const;
  Box box_in(const cv::Rect& square) const;
};

/// A patch mirrored left to right, and upside down: the same object to a viewer, but different input to a
/// network.
std::array<cv::Mat, 2> mirrored(const cv::Mat& patch);

/// The answer to a patch combined with those to mirrored(patch): the mean of the scores' logits and of the
/// centres, with size and sigma of the plain patch.
SecondLookAnswer agreed(const SecondLookAnswer& plain, const SecondLookAnswer& reversed,
                        const SecondLookAnswer& upside_down);

}  // namespace geoloc::io
