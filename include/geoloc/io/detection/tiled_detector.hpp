// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/detector.hpp"

namespace geoloc::io {

/// Searches a picture as a whole and each of its tiles (tiles.hpp). This finds small objects in large
/// pictures, which vanish when the whole picture is scaled down to a network's input. It costs 1 + tiles
/// times as much.
class TiledDetector final : public Detector {
 public:
  /// Throws std::invalid_argument for a bad configuration.
  TiledDetector(std::unique_ptr<Detector> detector, const DetectionConfig& config);

  std::vector<Detection> detect(const cv::Mat& bgr) override;
  const std::vector<std::string>& class_names() const override { return detector_->class_names(); }
  DetectorCounts counts() const override;

 private:
  std::unique_ptr<Detector> detector_;
  DetectionConfig config_;
  DetectorCounts counts_;
};

}  // namespace geoloc::io
