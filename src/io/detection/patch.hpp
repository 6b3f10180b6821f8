// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "geoloc/camera/detection.hpp"

// What a second look is given, and what it answers; tools/train/patches.py has the same.
namespace geoloc::io {

/// Around a box: twice its longer side, but at least 16 px and at most the picture's shorter side; in whole
/// pixels, and in part outside of the picture where the box is near its edge.
cv::Rect patch_around(const Box& box, cv::Size picture);

/// That square of the picture (8 bits, BGR), `side_px` wide and high; beyond the picture's edge its outermost
/// pixels go on.
cv::Mat cut_patch(const cv::Mat& bgr, const cv::Rect& square, int side_px);

/// Writes a patch as planes of red, green and blue [3, side, side]: each 0 in the mean, with the brightness'
/// standard deviation 1, so that neither exposure nor white balance matter.
void write_normalised(const cv::Mat& patch, float* planes);

/// A row of the network's output. Lengths are in sides of the square.
struct SecondLookAnswer {
  static constexpr int kValues = 6;

  explicit SecondLookAnswer(const float* values);

  double score;                       ///< 0..1: whether it is such an object
  double off_centre_x, off_centre_y;  ///< the object's centre, from that of the square
  double width, height;
  double sigma;  ///< 1-sigma of the centre, an axis

  /// Finite, of some size, and with a score in 0..1.
  bool is_sound() const;
  /// Neither sure of such an object nor of none.
  bool is_in_doubt() const;
  Box box_in(const cv::Rect& square) const;
};

/// A patch seen left to right reversed, and upside down: the same object to a viewer, others to a network.
std::array<cv::Mat, 2> mirrored(const cv::Mat& patch);

/// The answer to a patch with those to mirrored(patch) taken into account: the mean of the scores' logits and
/// of the centres; size and sigma as of the plain one.
SecondLookAnswer agreed(const SecondLookAnswer& plain, const SecondLookAnswer& reversed,
                        const SecondLookAnswer& upside_down);

}  // namespace geoloc::io
