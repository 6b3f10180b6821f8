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
  found.require((input_width_px == 0) == (input_height_px == 0),
                "detection.input_width_px and input_height_px: give both or none");
  found.require(input_width_px >= 0 && input_width_px <= kLongestInput_px,
                "detection.input_width_px must lie in [0, 8192]");
  found.require(input_height_px >= 0 && input_height_px <= kLongestInput_px,
                "detection.input_height_px must lie in [0, 8192]");
  found.require(tile_columns >= 1 && tile_columns <= 32, "detection.tile_columns must lie in [1, 32]");
  found.require(tile_rows >= 1 && tile_rows <= 32, "detection.tile_rows must lie in [1, 32]");
  found.require(tile_overlap_px >= 0 && tile_overlap_px <= 4096,
                "detection.tile_overlap_px must lie in [0, 4096]");
  found.require(second_look.confidence > 0 && second_look.confidence < 1,
                "detection.second_look.confidence must lie in (0, 1)");
  found.require(second_look.max_boxes >= 1 && second_look.max_boxes <= 1000,
                "detection.second_look.max_boxes must lie in [1, 1000]");
  return found.take();
}

}  // namespace geoloc::io
