// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "geoloc/camera/detection.hpp"

namespace geoloc::apps {

/// Draws each box, a point in its centre, and its class and confidence. `bgr`: 8 bits, 3 channels.
void draw_detections(cv::Mat& bgr, const std::vector<Detection>& detections,
                     const std::vector<std::string>& class_names);

}  // namespace geoloc::apps
