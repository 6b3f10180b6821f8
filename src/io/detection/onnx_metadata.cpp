// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/onnx_metadata.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "protobuf_fields.hpp"

// Field numbers are those of onnx/onnx.proto.
namespace geoloc::io {
namespace {

/// Calls `visit` for every field; false where the message is malformed.
template <typename Visit>
bool for_each_field(std::string_view message, Visit visit) {
  ProtobufReader reader{message};
  while (const auto field = reader.next()) visit(*field);
  return !reader.is_malformed();
}

/// The last field with that number counts, as in protobuf; empty if there is none.
std::string_view bytes_field(std::string_view message, std::uint64_t number) {
  std::string_view found;
  for_each_field(message, [&](const ProtobufField& field) {
    if (field.number == number && field.is_bytes) found = field.bytes;
  });
  return found;
}

std::string text_field(std::string_view message, std::uint64_t number) {
  return std::string{bytes_field(message, number)};
}

/// TensorShapeProto.Dimension: 1 dim_value, 2 dim_param.
std::int64_t length_of(std::string_view dimension) {
  std::int64_t length = kUnknownLength;
  for_each_field(dimension, [&](const ProtobufField& field) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
    if (field.number == 1 && field.is_integer && field.integer > 0 && field.integer <= kMost) {
      length = static_cast<std::int64_t>(field.integer);
    }
  });
  return length;
}

/// ValueInfoProto: 1 name, 2 type; TypeProto: 1 tensor_type; TypeProto.Tensor: 2 shape; TensorShapeProto: 1
/// dim.
OnnxTensor tensor_of(std::string_view value_info) {
  constexpr std::size_t kMostDimensions = 32;
  OnnxTensor tensor{text_field(value_info, 1), {}};
  const std::string_view shape = bytes_field(bytes_field(bytes_field(value_info, 2), 1), 2);
  for_each_field(shape, [&](const ProtobufField& field) {
    if (field.number != 1 || !field.is_bytes || tensor.shape.size() >= kMostDimensions) return;
    tensor.shape.push_back(length_of(field.bytes));
  });
  return tensor;
}

/// NodeProto: 1 input, 4 op_type.
void read_node(std::string_view node, OnnxMetadata& metadata) {
  constexpr std::size_t kMostKinds = 300, kLongestName = 100;
  const std::string_view kind = bytes_field(node, 4);
  if (metadata.operators.size() < kMostKinds && kind.size() <= kLongestName) metadata.operators.emplace(kind);
  std::size_t inputs = 0;
  for_each_field(node, [&](const ProtobufField& field) { inputs += field.number == 1 ? 1U : 0U; });
  if (inputs > 1 && kind == "Split") metadata.has_split_by_input = true;
}

/// TensorProto: 2 data_type.
bool is_half_float(std::string_view tensor) {
  constexpr std::uint64_t kFloat16 = 10;
  bool is_half = false;
  for_each_field(tensor, [&](const ProtobufField& field) {
    if (field.number == 2 && field.is_integer) is_half = field.integer == kFloat16;
  });
  return is_half;
}

/// GraphProto: 1 node, 5 initializer (TensorProto: 8 name), 11 input, 12 output.
bool read_graph(std::string_view graph, OnnxMetadata& metadata) {
  std::set<std::string> constants;
  const bool is_whole = for_each_field(graph, [&](const ProtobufField& field) {
    if (!field.is_bytes) return;
    if (field.number == 1) read_node(field.bytes, metadata);
    if (field.number == 5) constants.insert(text_field(field.bytes, 8));
    if (field.number == 5 && is_half_float(field.bytes)) metadata.has_half_floats = true;
    if (field.number == 11) metadata.inputs.push_back(tensor_of(field.bytes));
    if (field.number == 12) metadata.outputs.push_back(tensor_of(field.bytes));
  });
  const auto is_constant = [&](const OnnxTensor& tensor) { return constants.count(tensor.name) > 0; };
  metadata.inputs.erase(std::remove_if(metadata.inputs.begin(), metadata.inputs.end(), is_constant),
                        metadata.inputs.end());
  return is_whole;
}

/// OperatorSetIdProto: 1 domain, 2 version.
void read_opset(std::string_view opset, OnnxMetadata& metadata) {
  const std::string domain = text_field(opset, 1);
  if (!domain.empty() && domain != "ai.onnx") return;
  for_each_field(opset, [&](const ProtobufField& field) {
    if (field.number == 2 && field.is_integer) metadata.opset = static_cast<std::int64_t>(field.integer);
  });
}

}  // namespace

/// ModelProto: 7 graph, 8 opset_import, 14 metadata_props (StringStringEntryProto: 1 key, 2 value).
std::optional<OnnxMetadata> read_onnx_metadata(const std::uint8_t* data, std::size_t size) {
  OnnxMetadata metadata;
  bool has_graph = false;
  const std::string_view model{reinterpret_cast<const char*>(data), size};
  const bool is_whole = for_each_field(model, [&](const ProtobufField& field) {
    if (!field.is_bytes) return;
    if (field.number == 7) has_graph = read_graph(field.bytes, metadata);
    if (field.number == 8) read_opset(field.bytes, metadata);
    if (field.number == 14) metadata.properties[text_field(field.bytes, 1)] = text_field(field.bytes, 2);
  });
  if (!is_whole || !has_graph) return std::nullopt;
  return metadata;
}

}  // namespace geoloc::io
