// SPDX-License-Identifier: Apache-2.0
#include "model_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "output_facts.hpp"
#include "remedies.hpp"

namespace geoloc::io {
namespace {

constexpr std::uintmax_t kLargestFile = 2'000'000'000;  // protobuf's own limit is 2 GiB
constexpr std::int64_t kLargestPatchLength = 256;       // patches in a batch, or the side of one in pixels

std::vector<char> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) refuse_model(file, "cannot be read: " + error.message());
  if (size > kLargestFile) refuse_model(file, "too large for an ONNX file");
  std::ifstream stream{file, std::ios::binary};
  std::vector<char> bytes{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream || bytes.empty()) refuse_model(file, "is empty or cannot be read");
  return bytes;
}

/// The configuration sets what the file leaves open.
ImageSize input_size(const ModelFile& model, const DetectionConfig& config) {
  const std::filesystem::path& file = model.name;
  const OnnxMetadata& metadata = model.metadata;
  if (metadata.inputs.size() != 1) {
    refuse_model(file,
                 "has " + std::to_string(metadata.inputs.size()) + " inputs; a detector takes one image");
  }
  const auto& shape = metadata.inputs.front().shape;
  const auto is_open_or = [](std::int64_t length, std::int64_t wanted) {
    return length == kUnknownLength || length == wanted;
  };
  const auto is_side = [](std::int64_t length) { return length > 0 && length <= kLongestInput_px; };
  const std::string its_input = "its input is " + shape_text(shape);
  if (shape.size() != 4 || !is_open_or(shape[0], 1) || !is_open_or(shape[1], 3) ||
      !(shape[2] == kUnknownLength || is_side(shape[2])) ||
      !(shape[3] == kUnknownLength || is_side(shape[3]))) {
    refuse_model(file, its_input + "; it must be [1, 3, height, width]: export again with batch=1");
  }
  if (config.input_width_px > 0) {
    if (is_open_or(shape[2], config.input_height_px) && is_open_or(shape[3], config.input_width_px))
      return {config.input_width_px, config.input_height_px};
    refuse_model(file, its_input + ", not open to the " + std::to_string(config.input_width_px) + " x " +
                           std::to_string(config.input_height_px) +
                           " px of detection.input_width_px and input_height_px (--input-size)");
  }
  if (is_side(shape[2]) && is_side(shape[3])) return {static_cast<int>(shape[3]), static_cast<int>(shape[2])};
  refuse_model(file,
               its_input + ", which leaves its size open: " + remedy_for_open_input(model, config.backend));
}

/// The output that lists boxes: the only one, or the only one of the rank of a list. A model that segments
/// has another for the prototypes of its masks.
std::size_t output_of_boxes(const std::filesystem::path& file, const std::vector<OnnxTensor>& outputs) {
  if (outputs.size() == 1) return 0;
  const auto is_list = [](const OnnxTensor& output) { return output.shape.size() == 3; };
  if (std::count_if(outputs.begin(), outputs.end(), is_list) == 1)
    return static_cast<std::size_t>(std::find_if(outputs.begin(), outputs.end(), is_list) - outputs.begin());
  std::string shapes;
  for (const OnnxTensor& output : outputs) shapes += (shapes.empty() ? "" : ", ") + shape_text(output.shape);
  refuse_model(file,
               "has " + std::to_string(outputs.size()) + " outputs, " + shapes +
                   "; a detector lists boxes and scores in one of them, with three dimensions: export it "
                   "again in a layout of docs/detection.md");
}

ModelFile read_model_file(const std::filesystem::path& file) {
  ModelFile model;
  model.name = file;
  model.bytes = read_file(file);
  auto metadata =
      read_onnx_metadata(reinterpret_cast<const std::uint8_t*>(model.bytes.data()), model.bytes.size());
  if (!metadata) refuse_model(file, "is not an ONNX file, or is cut short: export with format=onnx");
  model.metadata = std::move(*metadata);
  return model;
}

}  // namespace

[[noreturn]] void refuse_model(const std::filesystem::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "[";
  for (const std::int64_t length : shape) {
    text += (text.size() > 1 ? ", " : "") + (length == kUnknownLength ? "?" : std::to_string(length));
  }
  return text + "]";
}

std::string one_line(std::string reason) {
  constexpr std::size_t kMost = 300;
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  reason.erase(0, reason.find_first_not_of("> "));  // OpenCV's quotes have "> " before each line
  reason.erase(reason.find_last_not_of("> ") + 1);
  if (reason.size() > kMost) reason = reason.substr(0, kMost) + "…";
  return reason;
}

ModelFile read_detector_file(const std::filesystem::path& file, const DetectionConfig& config) {
  ModelFile model = read_model_file(file);
  refuse_other_tasks(model);
  model.input = input_size(model, config);
  model.output = output_of_boxes(file, model.metadata.outputs);
  if (config.layout == OutputLayout::kYolox) model.kind = InputKind::kRawPicture;
  return model;
}

ModelFile read_second_look_file(const std::filesystem::path& file) {
  ModelFile model = read_model_file(file);
  const auto& inputs = model.metadata.inputs;
  const auto shape = inputs.size() == 1 ? inputs.front().shape : std::vector<std::int64_t>{};
  const auto is_length = [](std::int64_t length) { return length >= 1 && length <= kLargestPatchLength; };
  if (shape.size() != 4 || !is_length(shape[0]) || shape[1] != 3 || !is_length(shape[2]) ||
      shape[2] != shape[3])
    refuse_model(file,
                 "its input is " + shape_text(shape) + "; that of a second look is [batch, 3, side, side]");
  model.kind = InputKind::kNumbers;
  model.batch = static_cast<int>(shape[0]);
  model.input = {static_cast<int>(shape[3]), static_cast<int>(shape[2])};
  return model;
}

OnnxMetadata read_model_metadata(const std::filesystem::path& file) {
  return read_model_file(file).metadata;
}

std::vector<std::string> read_class_names(const std::filesystem::path& file) {
  std::ifstream stream{file};
  if (!stream) refuse_model(file, "cannot be read");
  std::vector<std::string> names;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    names.push_back(line);
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty()) refuse_model(file, "names no class; it must have one name a line");
  return names;
}

}  // namespace geoloc::io
