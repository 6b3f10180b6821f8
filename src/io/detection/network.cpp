// SPDX-License-Identifier: Apache-2.0
#include "network.hpp"

#include <algorithm>
#include <cmath>

#include "candidates.hpp"
#include "output_facts.hpp"
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

/// The class that a network names for a plain input is one, if its numbers mean what they are taken for.
void check_classes(const ModelFile& model, const cv::Mat& output, const OutputForm& form) {
  if (form.layout != OutputLayout::kEnd2end && form.layout != OutputLayout::kRtdetrTop) return;
  const std::vector<int> classes = best_scores({output.ptr<float>(), form}).class_ids;
  if (std::find(classes.begin(), classes.end(), -1) == classes.end()) return;
  refuse_model(model.name,
               "its output has the shape of chosen boxes, " + std::string{shape_of(form.layout)} +
                   ", but names no whole number below " + std::to_string(form.classes) +
                   " as a box's class: say how it lists boxes with detection.layout (--layout), or "
                   "name its classes with --class-names FILE");
}

/// The output for a plain input. Its values do not matter, but they must be numbers.
cv::Mat try_out(const ModelFile& model, Network& network) {
  const cv::Mat output = network.run(plain_input(model));
  const auto* values = output.ptr<float>();
  if (!std::all_of(values, values + output.total(), [](float value) { return std::isfinite(value); }))
    refuse_model(model.name,
                 "what it makes of a grey picture are no numbers (NaN or infinity): export again");
  return output;
}

std::vector<std::int64_t> lengths_of(const cv::Mat& output) {
  return {output.size.p, output.size.p + output.dims};
}

}  // namespace

DetectionNetwork load_network(const std::filesystem::path& file, std::optional<int> named_classes,
                              const DetectionConfig& config) {
  const ModelFile model = read_detector_file(file, config);
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
  const cv::Mat output = try_out(model, *network.network);
  network.form = settled_form(model, facts_of(model, lengths_of(output), named_classes), config.layout);
  check_classes(model, output, network.form);
  return network;
}

SecondLookNetwork load_second_look(const std::filesystem::path& file, const DetectionConfig& config) {
  const ModelFile model = read_second_look_file(file);
  SecondLookNetwork network{load(model, config), model.batch, model.input.width_px};
  const auto shape = lengths_of(try_out(model, *network.network));
  const std::vector<std::int64_t> wanted{model.batch, SecondLookAnswer::kValues};
  if (shape != wanted)
    refuse_model(file,
                 "its output is " + shape_text(shape) + "; that of a second look is " + shape_text(wanted));
  return network;
}

cv::Mat plain_input(const ModelFile& model) {
  if (model.kind != InputKind::kNumbers)
    return {model.input.height_px, model.input.width_px, CV_8UC3, kLetterboxGrey};
  return {std::vector<int>{model.batch, 3, model.input.height_px, model.input.width_px}, CV_32F,
          cv::Scalar::all(0)};
}

}  // namespace geoloc::io
