// SPDX-License-Identifier: Apache-2.0
#include "remedies.hpp"

#include <opencv2/core/version.hpp>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "output_facts.hpp"

namespace geoloc::io {
namespace {

bool is_convertible(const std::string& kind) {
  return (" " + std::string{kConvertibleOperators} + " ").find(" " + kind + " ") != std::string::npos;
}

/// The first few of the graph's operators for which there is no conversion; empty: none.
std::string inconvertible(const OnnxMetadata& metadata) {
  constexpr int kMostNamed = 4;
  std::string names;
  int count = 0;
  for (const std::string& kind : metadata.operators) {
    if (is_convertible(kind) || ++count > kMostNamed) continue;
    names += (names.empty() ? "" : ", ") + one_line(kind);
  }
  return count > kMostNamed ? names + " …" : names;
}

std::string with_openvino() {
  return std::string{"run it as it is with --backend openvino"} +
         (has_openvino() ? "" : " (bash scripts/openvino.sh installs it; then configure and build again)");
}

std::string conversion_of(const ModelFile& model, const std::string& size) {
  return "python3 tools/onnx_for_opencv.py " + model.name.string() + " " + model.name.stem().string() +
         "_opencv.onnx" + size;
}

constexpr const char* kExportUnchosen =
    "export it again so that it does not choose boxes itself (without nms=, or with end2end=False)";

}  // namespace

bool opencv_runs_exports() {
  return CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 8);
}

void refuse_what_opencv_mistakes(const ModelFile& model) {
  if (opencv_runs_exports() || !model.metadata.has_split_by_input) return;
  refuse_model(model.name, "OpenCV " CV_VERSION
                           " does not know Split as of opset 13, which this model of opset " +
                               std::to_string(model.metadata.opset) + " has; " + remedy_for_opencv(model));
}

std::string remedy_for_opencv(const ModelFile& model) {
  if (model.metadata.has_half_floats) return "export it again with half=False, or " + with_openvino();
  const std::string lacking = inconvertible(model.metadata);
  if (opencv_runs_exports() || !lacking.empty()) {
    return (lacking.empty() ? "" : "there is no conversion of its " + lacking + ": ") + with_openvino() +
           (has_selected(model.metadata).value_or(false) ? std::string{", or "} + kExportUnchosen : "");
  }
  const auto& shape = model.metadata.inputs.front().shape;
  const bool is_open = shape.size() == 4 && (shape[2] == kUnknownLength || shape[3] == kUnknownLength);
  const bool is_sized = model.input.width_px > 0;
  const std::string size = !is_open   ? ""
                           : is_sized ? " --input-size " + std::to_string(model.input.width_px) + " " +
                                            std::to_string(model.input.height_px)
                                      : " --input-size WIDTH HEIGHT";
  return "convert it: " + conversion_of(model, size) + ", or " + with_openvino();
}

std::string remedy_for_openvino(const ModelFile& model) {
  if (has_selected(model.metadata).value_or(false)) return kExportUnchosen;
  return "export it again with another opset, for example opset=17";
}

std::string remedy_for_open_input(const ModelFile& model, Backend backend) {
  if (backend == Backend::kOpencv && !opencv_runs_exports())
    return "convert it to one: " + conversion_of(model, " --input-size WIDTH HEIGHT") +
           ", or give one with detection.input_width_px and input_height_px (--input-size) and run it with "
           "--backend openvino";
  return "give one with detection.input_width_px and input_height_px (--input-size), or export again with "
         "dynamic=False";
}

}  // namespace geoloc::io
