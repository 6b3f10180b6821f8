// SPDX-License-Identifier: Apache-2.0
#include "output_facts.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "io/detection/detection_fields.hpp"

namespace geoloc::io {
namespace {

constexpr const char* kSetting = "detection.layout (--layout)";

std::string property(const OnnxMetadata& metadata, const char* key) {
  const auto found = metadata.properties.find(key);
  return found == metadata.properties.end() ? std::string{} : found->second;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// "head" names the network's last part in newer exports; "description" names the network in all.
std::optional<bool> is_rtdetr(const OnnxMetadata& metadata) {
  const std::string head = property(metadata, "head");
  if (!head.empty()) return contains(head, "RTDETR");
  std::string description = property(metadata, "description");
  std::transform(description.begin(), description.end(), description.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool names_it = contains(description, "rtdetr") || contains(description, "rt-detr");
  return names_it ? std::optional{true} : std::nullopt;
}

/// Channels of the prototypes [1, M, height, width] beside the boxes.
int mask_coefficients(const ModelFile& model) {
  constexpr std::int64_t kMost = 1024;
  const auto& outputs = model.metadata.outputs;
  if (outputs.size() != 2) return 0;
  const auto& shape = outputs[1 - model.output].shape;
  return shape.size() == 4 && shape[1] > 0 && shape[1] <= kMost ? static_cast<int>(shape[1]) : 0;
}

std::string described(const OutputFacts& facts) {
  std::string text = "its output is " + shape_text(facts.shape);
  if (facts.classes) text += " for " + std::to_string(*facts.classes) + " named classes";
  return text;
}

[[noreturn]] void refuse_unlisted(const ModelFile& model, const OutputFacts& facts, OutputLayout wanted) {
  if (wanted != OutputLayout::kAuto) {
    refuse_model(model.name, described(facts) + ", not " + shape_of(wanted) + " as of " + kSetting + " " +
                                 name_of(wanted) + "; auto finds out which it is");
  }
  std::string candidates;
  for (const auto& [layout, name] : EnumNames<OutputLayout>::all) {
    if (layout == OutputLayout::kAuto) continue;
    const std::vector<OutputForm> forms = possible_forms(facts, layout);
    if (!forms.empty() && forms.front().values < forms.front().candidates)
      candidates += std::string{candidates.empty() ? "" : " or "} + name;
  }
  if (!candidates.empty()) {
    refuse_model(model.name, described(facts) +
                                 ", of which nothing tells how it lists boxes: if it is as of " + candidates +
                                 " (docs/detection.md), say so with " + kSetting);
  }
  refuse_model(model.name,
               described(facts) + ", not " + shape_of(OutputLayout::kYolo11) +
                   " as of YOLO11, nor any other layout of docs/detection.md: export it in one of "
                   "these" +
                   (facts.classes ? ", with names of just its classes" : ""));
}

}  // namespace

/// Ultralytics writes "end2end" as of 8.3; before, only the arguments of an export with nms=True tell.
std::optional<bool> has_selected(const OnnxMetadata& metadata) {
  const std::string end2end = property(metadata, "end2end");
  if (end2end == "True" || contains(property(metadata, "args"), "'nms': True")) return true;
  return end2end == "False" ? std::optional{false} : std::nullopt;
}

void refuse_other_tasks(const ModelFile& model) {
  const std::string task = property(model.metadata, "task");
  const std::string with_boxes[] = {"", "detect", "obb", "segment", "pose"};
  if (std::find(std::begin(with_boxes), std::end(with_boxes), task) != std::end(with_boxes)) return;
  refuse_model(model.name, "it is a model for the task " + one_line(task) +
                               ", which gives no boxes: take one for detect, obb, segment or pose");
}

OutputFacts facts_of(const ModelFile& model, std::vector<std::int64_t> shape,
                     std::optional<int> named_classes) {
  OutputFacts facts;
  facts.shape = std::move(shape);
  const auto names = parse_class_names(property(model.metadata, "names"));
  facts.classes = names ? std::optional{static_cast<int>(names->size())} : named_classes;
  facts.task = property(model.metadata, "task");
  facts.has_selected = has_selected(model.metadata);
  facts.is_rtdetr = is_rtdetr(model.metadata);
  facts.mask_coefficients = mask_coefficients(model);
  facts.input = model.input;
  return facts;
}

OutputForm settled_form(const ModelFile& model, const OutputFacts& facts, OutputLayout wanted) {
  const std::vector<OutputForm> forms = possible_forms(facts, wanted);
  if (forms.empty()) refuse_unlisted(model, facts, wanted);
  if (forms.size() > 1) {
    std::string names;
    for (const OutputForm& form : forms)
      names += std::string{names.empty() ? "" : " or "} + name_of(form.layout);
    refuse_model(model.name, described(facts) + ", which may list boxes as of " + names +
                                 " (docs/detection.md): say which with " + kSetting);
  }
  if (forms.front().classes < 1) {
    refuse_model(model.name,
                 described(facts) +
                     ", which does not tell how many classes there are, and its metadata name none: "
                     "name them with --class-names FILE");
  }
  return forms.front();
}

}  // namespace geoloc::io
