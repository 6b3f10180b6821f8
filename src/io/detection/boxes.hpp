// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"
#include "rotated_box.hpp"

namespace geoloc::io {

/// A detection whose outline may be a rotated box; its own box is then the upright one around that.
struct OutlinedDetection : Detection {
  std::optional<RotatedBox> rotated;
};

/// Greedy suppression: in order of confidence, keeps each box that does not overlap a kept one of its class,
/// up to the configuration's max_detections.
std::vector<Detection> suppress_overlaps(std::vector<Detection> boxes, const DetectionConfig& config);

/// The same, where rotated boxes overlap as probabilistic_overlap() says.
std::vector<OutlinedDetection> suppress_overlaps(std::vector<OutlinedDetection> boxes,
                                                 const DetectionConfig& config);

/// The most confident ones in order, up to the configuration's max_detections.
std::vector<OutlinedDetection> most_confident(std::vector<OutlinedDetection> boxes,
                                              const DetectionConfig& config);

/// The part of the box inside the picture; nullopt if there is none.
std::optional<Box> clipped(const Box& box, ImageSize picture);

/// Detection::sigma_px for the centre of a box that has not been clipped to the picture yet. It is 0 (not
/// stated) for a box that will be clipped, because its centre is then not the object's, and for a sigma that
/// is no number.
double stated_sigma_px(double sigma_px, const Box& whole, ImageSize picture);

}  // namespace geoloc::io
