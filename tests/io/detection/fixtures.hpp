// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "support/source_tree.hpp"

namespace geoloc::io {

/// A network of tools/fixtures/make_onnx_fixtures.py.
inline std::filesystem::path fixture(const std::string& name) {
  return test_data() / "onnx" / (name + ".onnx");
}

/// The back ends that were built in.
inline std::vector<Backend> backends() {
  if (has_openvino()) return {Backend::kOpencv, Backend::kOpenvino};
  return {Backend::kOpencv};
}

inline std::string backend_name(const ::testing::TestParamInfo<Backend>& instance) {
  return instance.param == Backend::kOpencv ? "opencv" : "openvino";
}

inline DetectionConfig with(Backend backend, OutputLayout layout = OutputLayout::kAuto) {
  DetectionConfig config;
  config.backend = backend;
  config.layout = layout;
  return config;
}

/// Why no detector can be made of them; "none" where one can.
inline std::string fault_of(const DetectorFiles& files, const DetectionConfig& config) {
  try {
    const YoloDetector detector{files, config};
    return "none";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

inline const cv::Scalar kRed{0, 0, 255};

}  // namespace geoloc::io
