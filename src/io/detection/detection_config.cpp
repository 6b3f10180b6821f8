// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/detection_config.hpp"

#include "geoloc/geometry/problems.hpp"

namespace geoloc::io {

std::vector<std::string> DetectionConfig::problems() const {
  Problems found;
  found.require(confidence > 0 && confidence < 1, "detection.confidence must lie in (0, 1)");
  found.require(nms_iou > 0 && nms_iou <= 1, "detection.nms_iou must lie in (0, 1]");
  found.require(max_detections >= 1 && max_detections <= 10'000,
                "detection.max_detections must lie in [1, 10000]");
  found.require(threads >= 0 && threads <= 256, "detection.threads must lie in [0, 256]");
  return found.take();
}

}  // namespace geoloc::io
