// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/detector.hpp"

namespace geoloc::io {

/// Looks again, and closer, at each box that another detector proposes. A small network sees the box and its
/// surroundings, normalised in size and brightness, and says whether the box holds such an object, where its
/// centre is, and how accurate that is. It distinguishes objects from look-alikes, and small ones from
/// background, better than a network that has to search a whole picture.
///
/// The network: ONNX, patches [batch, 3, side, side] (docs/detection.md) to answers [batch, 6].
class SecondLookDetector final : public Detector {
 public:
  /// `first` should propose too much rather than too little (proposing()). A confidence of 0 is that of
  /// models made for geoloc. Throws std::runtime_error naming the file, the fault and the remedy;
  /// std::invalid_argument for a bad configuration.
  SecondLookDetector(std::unique_ptr<Detector> first, const std::filesystem::path& network,
                     const DetectionConfig& config);
  ~SecondLookDetector() override;
  SecondLookDetector(const SecondLookDetector&) = delete;
  SecondLookDetector& operator=(const SecondLookDetector&) = delete;

  std::vector<Detection> detect(const cv::Mat& bgr) override;
  const std::vector<std::string>& class_names() const override;
  DetectorCounts counts() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The configuration of a detector that proposes boxes for a second look.
DetectionConfig proposing(DetectionConfig config);

}  // namespace geoloc::io
