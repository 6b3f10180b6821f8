// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"
#include "geoloc/io/detection/output_layout.hpp"

namespace geoloc::io {

/// What a network made of a picture: form.candidates x form.values numbers, in the order of form.layout.
struct YoloOutput {
  const float* values = nullptr;
  OutputForm form;
};

/// Per-axis 1-sigma of a box's centre in pixels of the network's input: hypot(constant_px, of_size * size),
/// where size is the square root of the box's area there.
struct CentreSigma {
  double constant_px = 0.0;
  double of_size = 0.0;
};

struct DecodedBoxes {
  std::vector<Detection> detections;  ///< in pixels of the picture, clipped to it, most confident first
  std::size_t rejected = 0;  ///< confident boxes that are not finite or of no size, or of no class; scores
                             ///< above 1 or NaN
  double best_score_below = 0.0;  ///< of the candidates that did not reach the threshold
};

/// Applies the threshold and, where the network did not, non-maximum suppression within each class, and maps
/// boxes from the network's input to the picture. A candidate counts only for its best class. Of a rotated
/// box, the upright box around it is given; suppression compares the rotated ones. Boxes are clipped to the
/// picture. Without `sigma`, and for clipped boxes, Detection::sigma_px is not stated. `input`: of the
/// network.
DecodedBoxes decode_yolo(const YoloOutput& output, const Letterbox& letterbox, ImageSize input,
                         ImageSize picture, const DetectionConfig& config,
                         const std::optional<CentreSigma>& sigma = {});

/// Area of the intersection over that of the union; 0 where they do not touch.
double intersection_over_union(const Box& a, const Box& b);

}  // namespace geoloc::io
