// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/dnn.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// A detection network that OpenCV has loaded and run.
struct OnnxNetwork {
  cv::dnn::Net net;
  ImageSize input;
  int classes = 0;
  int candidates = 0;
  std::optional<std::vector<std::string>> class_names;  ///< as the file has them
};

/// Throws std::runtime_error naming the file, the fault and the remedy.
OnnxNetwork load_onnx_network(const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where it cannot be read or names no class.
std::vector<std::string> read_class_names(const std::filesystem::path& file);

}  // namespace geoloc::io
