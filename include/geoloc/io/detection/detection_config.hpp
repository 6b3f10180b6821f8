// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc::io {

/// "detection" in the configuration file.
struct DetectionConfig {
  double confidence = 0.60;  ///< boxes with a lower score are dropped
  double nms_iou = 0.5;      ///< of two boxes of a class that overlap more, the less confident one is dropped
  int max_detections = 300;  ///< in a picture
  int threads = 0;           ///< of OpenCV, in the whole program; 0: as many as it likes

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
