// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"
#include "geoloc/io/detection/onnx_metadata.hpp"

namespace geoloc::io {

/// Kind of input that a network takes.
enum class InputKind {
  kPicture,     ///< one, 8 bits, BGR; the back end makes it RGB in 0..1
  kRawPicture,  ///< the same, left as it is
  kNumbers      ///< 32-bit floats, as they are
};

/// An ONNX file with one input of the shape [batch, 3, height, width].
struct ModelFile {
  std::filesystem::path name;
  std::vector<char> bytes;
  OnnxMetadata metadata;
  InputKind kind = InputKind::kPicture;
  int batch = 1;
  ImageSize input;         ///< the file's, or the configuration's where the file leaves it open
  std::size_t output = 0;  ///< which of its outputs is the answer
};

/// Reads the file of a detector. Each of these throws std::runtime_error naming the file, the fault and the
/// remedy.
ModelFile read_detector_file(const std::filesystem::path& file, const DetectionConfig& config);

/// Reads the file of a second-look network, which takes several square patches at once.
ModelFile read_second_look_file(const std::filesystem::path& file);

/// The metadata of any of them alone.
OnnxMetadata read_model_metadata(const std::filesystem::path& file);

/// Reads one name per line. Throws std::runtime_error naming the file if it cannot be read or names no class.
std::vector<std::string> read_class_names(const std::filesystem::path& file);

/// Throws std::runtime_error: "FILE: FAULT".
[[noreturn]] void refuse_model(const std::filesystem::path& file, const std::string& fault);

/// "[1, 3, ?, 640]".
std::string shape_text(const std::vector<std::int64_t>& shape);

/// Joins lines and truncates long texts, to quote a back end's message within ours.
std::string one_line(std::string reason);

}  // namespace geoloc::io
