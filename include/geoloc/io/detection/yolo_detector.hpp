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
  std::filesystem::path model;                       ///< ONNX, with an output as of output_layout.hpp
  std::optional<std::filesystem::path> class_names;  ///< one name per line; without it, those in the model
  /// Network for second looks (second_look.hpp); empty: none; unset: the one that the model's metadata name,
  /// beside the model.
  std::optional<std::filesystem::path> second_look = {};
};

/// A YOLO network run on the CPU over whole pictures. It ignores the settings of tiles and second looks,
/// which open_detector() applies.
class YoloDetector final : public Detector {
 public:
  /// Reads the model and runs it once, so that any fault in it is found here. Throws std::runtime_error
  /// naming the file, the fault and the remedy; std::invalid_argument for a bad configuration. Sets the
  /// number of OpenCV's threads, which the whole program shares, if OpenCV is the back end and the
  /// configuration names one.
  YoloDetector(const DetectorFiles& files, const DetectionConfig& config);
  ~YoloDetector() override;
  YoloDetector(const YoloDetector&) = delete;
  YoloDetector& operator=(const YoloDetector&) = delete;

  std::vector<Detection> detect(const cv::Mat& bgr) override;
  const std::vector<std::string>& class_names() const override;
  DetectorCounts counts() const override;

  ImageSize input_size() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The detector that files and configuration specify: with or without tiles, with or without a second look.
/// Throws as YoloDetector does.
std::unique_ptr<Detector> open_detector(const DetectorFiles& files, const DetectionConfig& config);

/// The configuration with what it leaves to the model: where its confidence is 0, a geoloc model's, told by
/// metadata that begin with geoloc_, or that of all others. Throws as YoloDetector does where the file cannot
/// be read.
DetectionConfig with_model_defaults(const DetectorFiles& files, DetectionConfig config);

inline constexpr double kConfidenceOfOurModels = 0.8;     // docs/model.md says why
inline constexpr double kConfidenceOfOtherModels = 0.25;  // as ultralytics, whose models are trained for it

/// Whether Backend::kOpenvino can be chosen.
bool has_openvino();

}  // namespace geoloc::io
