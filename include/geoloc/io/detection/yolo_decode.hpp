// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// The output [1, 4 + classes, candidates] of YOLO11 and its relatives (v8 to v12). Its rows, with one value
/// per candidate, are centre x, centre y, width, height in pixels of the network's input (continuous edges),
/// then one score in 0..1 per class.
struct YoloOutput {
  static constexpr int kBoxRows = 4;

  const float* values = nullptr;
  int classes = 0;
  int candidates = 0;
};

/// Per-axis 1-sigma of a box's centre in pixels of the network's input: hypot(constant_px, of_size * size),
/// where size is the square root of the box's area there.
struct CentreSigma {
  double constant_px = 0.0;
  double of_size = 0.0;
};

struct DecodedBoxes {
  std::vector<Detection> detections;  ///< in pixels of the picture, clipped to it, most confident first
  std::size_t rejected = 0;  ///< confident boxes that are not finite or of no size; scores above 1 or NaN
  double best_score_below = 0.0;  ///< of the candidates that did not reach the threshold
};

/// Applies the threshold and non-maximum suppression within each class, and maps boxes from the network's
/// input to the picture. A candidate counts only for its best class. Boxes are clipped to the picture.
/// Without `sigma`, and for clipped boxes, Detection::sigma_px is not stated.
DecodedBoxes decode_yolo(const YoloOutput& output, const Letterbox& letterbox, ImageSize picture,
                         const DetectionConfig& config, const std::optional<CentreSigma>& sigma = {});

/// Area of the intersection over that of the union; 0 where they do not touch.
double intersection_over_union(const Box& a, const Box& b);

}  // namespace geoloc::io
