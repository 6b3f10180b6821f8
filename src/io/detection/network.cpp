// SPDX-License-Identifier: Apache-2.0
#include "network.hpp"

#include <algorithm>
#include <cmath>

#include "patch.hpp"

namespace geoloc::io {
namespace {

std::unique_ptr<Network> load(const ModelFile& model, const DetectionConfig& config) {
  switch (config.backend) {
    case Backend::kOpencv:
      return load_with_opencv(model);
    case Backend::kOpenvino:
      return load_with_openvino(model, config.threads);
  }
  refuse_model(model.name, "no such back end");
}

void check_shape(const ModelFile& model, const std::vector<std::int64_t>& shape, DetectionNetwork& network) {
  const bool has_names = network.class_names.has_value();
  const std::size_t rows = has_names ? YoloOutput::kBoxRows + network.class_names->size() : 0;
  const bool fits = shape.size() == 3 && shape[0] == 1 && shape[1] > YoloOutput::kBoxRows &&
                    (has_names ? static_cast<std::size_t>(shape[1]) == rows : shape[1] < shape[2]);
  if (!fits) {
    refuse_model(model.name, "its output is " + shape_text(shape) + ", not [1, " +
                                 (has_names ? std::to_string(rows) : "4 + classes") +
                                 ", candidates] as of YOLO11 detection models; YOLOv5's layout, exports with "
                                 "nms=True, and models for segmentation, pose or rotated boxes are not "
                                 "supported");
  }
  network.classes = static_cast<int>(shape[1]) - YoloOutput::kBoxRows;
  network.candidates = static_cast<int>(shape[2]);
}

/// The shape of the output for a plain input. Its values do not matter, but they must be numbers.
std::vector<std::int64_t> try_out(const ModelFile& model, Network& network) {
  const cv::Mat output = network.run(plain_input(model));
  const auto* values = output.ptr<float>();
  if (!std::all_of(values, values + output.total(), [](float value) { return std::isfinite(value); }))
    refuse_model(model.name,
                 "what it makes of a grey picture are no numbers (NaN or infinity): export again");
  return {output.size.p, output.size.p + output.dims};
}

}  // namespace

DetectionNetwork load_network(const std::filesystem::path& file, const DetectionConfig& config) {
  const ModelFile model = read_detector_file(file, config);
  if (model.metadata.outputs.size() != 1) {
    refuse_model(file, "has " + std::to_string(model.metadata.outputs.size()) +
                           " outputs; a detector has one (segmentation is not supported)");
  }
  DetectionNetwork network;
  network.input = model.input;
  const auto& properties = model.metadata.properties;
  if (const auto names = properties.find("names"); names != properties.end())
    network.class_names = parse_class_names(names->second);
  if (const auto sigma = properties.find(kCentreSigmaKey); sigma != properties.end()) {
    network.centre_sigma = parse_centre_sigma(sigma->second);
    if (!network.centre_sigma)
      refuse_model(file, std::string{"its metadata's "} + kCentreSigmaKey +
                             " is not \"a,b\", two numbers of which a > 0 and b >= 0");
  }
  network.network = load(model, config);
  check_shape(model, try_out(model, *network.network), network);
  return network;
}

SecondLookNetwork load_second_look(const std::filesystem::path& file, const DetectionConfig& config) {
  const ModelFile model = read_second_look_file(file);
  SecondLookNetwork network{load(model, config), model.batch, model.input.width_px};
  const auto shape = try_out(model, *network.network);
  const std::vector<std::int64_t> wanted{model.batch, SecondLookAnswer::kValues};
  if (shape != wanted)
    refuse_model(file,
                 "its output is " + shape_text(shape) + "; that of a second look is " + shape_text(wanted));
  return network;
}

cv::Mat plain_input(const ModelFile& model) {
  if (model.kind == InputKind::kPicture)
    return {model.input.height_px, model.input.width_px, CV_8UC3, kLetterboxGrey};
  return {std::vector<int>{model.batch, 3, model.input.height_px, model.input.width_px}, CV_32F,
          cv::Scalar::all(0)};
}

}  // namespace geoloc::io
