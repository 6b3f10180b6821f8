// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "geoloc/camera/detection.hpp"

namespace geoloc::io {

struct DetectorCounts {
  std::uint64_t images = 0;           ///< given to detect()
  std::uint64_t unusable_images = 0;  ///< empty, or not 8 bits with 1, 3 or 4 channels
  std::uint64_t failed_images = 0;    ///< the network failed on them
  std::uint64_t rejected_boxes = 0;   ///< with an impossible size or score
  double best_score_below = 0.0;      ///< of all that did not reach DetectionConfig::confidence
};

/// Finds objects in pictures. Used by one thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;

  /// `bgr`: 8 bits with 3 channels, or 1 (grey), or 4 (the last one ignored). Boxes are in pixels of that
  /// picture, clipped to it, most confident first. Never throws: failures are counted and give no detections.
  virtual std::vector<Detection> detect(const cv::Mat& bgr) = 0;

  /// class_names()[Detection::class_id].
  virtual const std::vector<std::string>& class_names() const = 0;

  virtual DetectorCounts counts() const = 0;

 protected:
  Detector() = default;
  Detector(const Detector&) = default;
  Detector& operator=(const Detector&) = default;
};

}  // namespace geoloc::io
