// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geoloc/io/detection/yolo_decode.hpp"

namespace geoloc::io {

/// An input or output of an ONNX graph.
struct OnnxTensor {
  std::string name;
  std::vector<std::int64_t> shape;  ///< kUnknownLength where a length is symbolic or missing
};

constexpr std::int64_t kUnknownLength = -1;

/// What OpenCV's importer does not expose.
struct OnnxMetadata {
  std::int64_t opset = 0;          ///< of the operators of ONNX itself
  std::vector<OnnxTensor> inputs;  ///< without those that have a constant value
  std::vector<OnnxTensor> outputs;
  std::map<std::string, std::string> properties;  ///< metadata_props
  std::set<std::string> operators;                ///< of the graph's nodes, the first few hundred kinds
  bool has_split_by_input = false;                ///< a Split whose sizes are an input, as of opset 13
  bool has_half_floats = false;                   ///< constants of 16 bits
};

/// Reads the few fields above out of an ONNX file's bytes; all others are skipped. nullopt where the bytes
/// are not a protobuf message with a graph in it. Takes any bytes.
std::optional<OnnxMetadata> read_onnx_metadata(const std::uint8_t* data, std::size_t size);

/// The names in ultralytics' property "names": a Python dictionary, {0: 'person', 1: "driver's seat"}.
/// nullopt where it is not one, or where its keys are not 0, 1, 2 … Takes any text.
std::optional<std::vector<std::string>> parse_class_names(std::string_view dictionary);

/// How the properties begin that only models made for geoloc have.
inline constexpr const char* kOurKeys = "geoloc_";

/// The property kCentreSigmaKey: "a,b", two decimal numbers, a > 0 and b >= 0 (yolo_decode.hpp). nullopt
/// where it is anything else. Takes any text.
std::optional<CentreSigma> parse_centre_sigma(std::string_view text);
inline constexpr const char* kCentreSigmaKey = "geoloc_centre_sigma_px";

/// The property that names the file of a network for second looks, which lies beside the model.
inline constexpr const char* kSecondLookKey = "geoloc_second_look";

}  // namespace geoloc::io
