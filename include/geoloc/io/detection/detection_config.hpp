// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc::io {

/// What runs a network.
enum class Backend {
  kOpencv,   ///< OpenCV's DNN module
  kOpenvino  ///< faster; only where geoloc was built with it (scripts/openvino.sh)
};

inline constexpr int kLongestInput_px = 8192;

/// How a network's output lists its boxes (output_layout.hpp).
enum class OutputLayout {
  kAuto,  ///< as its metadata and shape tell
  kYolo11,
  kObb,
  kSegment,
  kPose,
  kEnd2end,
  kRtdetr,
  kRtdetrTop,
  kYolov5,
  kYolox
};

/// "detection.second_look": which boxes are looked at once more, by models that have a network for that.
struct SecondLookConfig {
  double confidence = 0.1;  ///< of the first look
  int max_boxes = 40;       ///< per picture: a limit on the time it takes
};

/// "detection" in the configuration file.
struct DetectionConfig {
  double confidence = 0.0;  ///< 0: the model's own (usual_confidence() in yolo_detector.hpp)
  double nms_iou = 0.5;
  int max_detections = 300;  ///< per picture
  int threads = 0;           ///< 0: one per core
  Backend backend = Backend::kOpencv;
  OutputLayout layout = OutputLayout::kAuto;
  int input_width_px = 0;  ///< of the network's input, for models that leave it open; 0: the model's own
  int input_height_px = 0;
  int tile_columns = 1;
  int tile_rows = 1;
  int tile_overlap_px = 64;  ///< of neighbours, in the picture
  SecondLookConfig second_look = {};

  /// Every fault, named by its path.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
