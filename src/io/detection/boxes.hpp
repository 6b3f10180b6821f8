// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// Greedy: from the most confident box on, each one stays that does not overlap one of its class that stayed,
/// up to the configuration's max_detections.
std::vector<Detection> suppress_overlaps(std::vector<Detection> boxes, const DetectionConfig& config);

/// What of it is in the picture; nullopt where that is nothing.
std::optional<Box> clipped(const Box& box, ImageSize picture);

/// What Detection::sigma_px is to say of the centre of a box before it is cut off at the picture's edge: 0
/// (not stated) where it will be, as its centre is then another than the object's, and for what is no number.
double stated_sigma_px(double sigma_px, const Box& whole, ImageSize picture);

}  // namespace geoloc::io
