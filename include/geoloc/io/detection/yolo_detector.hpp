// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

struct DetectorFiles {
  std::filesystem::path model;  ///< ONNX, output [1, 4 + classes, candidates] (yolo_decode.hpp)
  std::optional<std::filesystem::path> class_names;  ///< a name a line; without it, those in the model
};

/// A YOLO network run by OpenCV's DNN module on the CPU.
class OpencvDetector final : public Detector {
 public:
  /// Reads the model and runs it once, so that whatever is wrong with it is found here. Throws
  /// std::runtime_error naming the file, the fault and the remedy; std::invalid_argument for a bad
  /// configuration. Sets the number of OpenCV's threads, which the whole program shares, if the configuration
  /// names one.
  OpencvDetector(const DetectorFiles& files, const DetectionConfig& config);
  ~OpencvDetector() override;
  OpencvDetector(const OpencvDetector&) = delete;
  OpencvDetector& operator=(const OpencvDetector&) = delete;

  std::vector<Detection> detect(const cv::Mat& bgr) override;
  const std::vector<std::string>& class_names() const override;
  DetectorCounts counts() const override;

  ImageSize input_size() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
