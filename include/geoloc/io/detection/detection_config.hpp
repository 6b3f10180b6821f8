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

/// "detection.second_look": which boxes are looked at once more, by models that have a network for that.
struct SecondLookConfig {
  double confidence = 0.1;  ///< of the first look, from which on
  int max_boxes = 40;       ///< in a picture, the most confident ones: a limit on the time it takes
};

/// "detection" in the configuration file.
struct DetectionConfig {
  double confidence = 0.80;  ///< boxes with a lower score are dropped
  double nms_iou = 0.5;      ///< of two boxes of a class that overlap more, the less confident one is dropped
  int max_detections = 300;  ///< in a picture
  int threads = 0;           ///< of the back end; OpenCV's are the whole program's; 0: all cores
  Backend backend = Backend::kOpencv;
  int input_width_px = 0;   ///< of the network's input, for models that leave it open; 0: the model's own
  int input_height_px = 0;  ///< likewise
  int tile_columns = 1;     ///< a picture is cut into so many by so many tiles; 1 by 1: it is not cut
  int tile_rows = 1;
  int tile_overlap_px = 64;  ///< of neighbours, in the picture: no less than an object that matters is long
  SecondLookConfig second_look = {};

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
