// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/output_layout.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace geoloc::io {
namespace {

constexpr std::int64_t kBox = 4;
constexpr std::int64_t kScoreAndClass = 2;
constexpr std::int64_t kAnchorsPerCell = 3;  // of YOLOv5
constexpr std::int64_t kMostQueries = 1000;  // RT-DETR has 300
constexpr std::array kLayouts{OutputLayout::kYolo11,    OutputLayout::kObb,     OutputLayout::kSegment,
                              OutputLayout::kPose,      OutputLayout::kEnd2end, OutputLayout::kRtdetr,
                              OutputLayout::kRtdetrTop, OutputLayout::kYolov5,  OutputLayout::kYolox};

/// Whether a candidate has one score and the number of its class.
bool names_class(OutputLayout layout) {
  return layout == OutputLayout::kEnd2end || layout == OutputLayout::kRtdetrTop;
}

/// Numbers of a candidate besides box and scores, where the layout fixes them.
std::int64_t extra_values(OutputLayout layout, const OutputFacts& facts) {
  switch (layout) {
    case OutputLayout::kObb:
    case OutputLayout::kYolov5:
    case OutputLayout::kYolox:
      return 1;
    case OutputLayout::kSegment:
      return facts.mask_coefficients;
    case OutputLayout::kEnd2end:
      return facts.task == "obb" ? 1 : facts.mask_coefficients;
    default:
      return 0;
  }
}

/// The number of classes that gives a candidate so many values; nullopt: none does.
std::optional<std::int64_t> classes_of(OutputLayout layout, const OutputFacts& facts, std::int64_t values) {
  if (facts.classes && *facts.classes < 1) return std::nullopt;
  const std::int64_t rest = values - kBox - extra_values(layout, facts);
  const bool has_key_points =
      layout == OutputLayout::kPose || (layout == OutputLayout::kEnd2end && facts.task == "pose");
  if (names_class(layout)) {
    const bool fits = has_key_points ? rest > kScoreAndClass : rest == kScoreAndClass;
    return fits ? std::optional<std::int64_t>{facts.classes.value_or(0)} : std::nullopt;
  }
  if (has_key_points) {  // people are the usual only class
    const std::int64_t classes = facts.classes.value_or(1);
    return rest > classes ? std::optional{classes} : std::nullopt;
  }
  if (rest < 1 || (facts.classes && *facts.classes != rest)) return std::nullopt;
  return rest;
}

std::optional<OutputForm> form_of(OutputLayout layout, const OutputFacts& facts) {
  if (facts.shape.size() != 3 || facts.shape[0] != 1) return std::nullopt;
  const bool is_last = lists_candidates_last(layout);
  const std::int64_t values = facts.shape[is_last ? 1 : 2], candidates = facts.shape[is_last ? 2 : 1];
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  if (values < 1 || candidates < 1 || values > kMost / candidates) return std::nullopt;
  const bool is_read_across = !facts.classes && !names_class(layout) && values >= candidates;
  if (is_read_across) return std::nullopt;  // names alone would show that there are so many classes
  if (layout == OutputLayout::kSegment && facts.mask_coefficients == 0) return std::nullopt;
  if (layout == OutputLayout::kYolox && candidates != grid_cells(facts.input)) return std::nullopt;
  const auto classes = classes_of(layout, facts, values);
  if (!classes) return std::nullopt;
  const bool is_rotated =
      layout == OutputLayout::kObb || (layout == OutputLayout::kEnd2end && facts.task == "obb");
  return OutputForm{layout, static_cast<int>(*classes), static_cast<int>(candidates),
                    static_cast<int>(values), is_rotated};
}

/// Whether nothing speaks against that layout.
bool is_plausible(const OutputForm& form, const OutputFacts& facts) {
  const bool is_detection = facts.task.empty() || facts.task == "detect";
  const bool has_selected = facts.has_selected.value_or(false);
  const std::int64_t cells = grid_cells(facts.input);
  const bool is_few = form.candidates < std::min(cells, kMostQueries + 1);
  const bool is_longer_than_wide = form.values < form.candidates;  // key points may be any number
  switch (form.layout) {
    case OutputLayout::kYolo11:
      return is_detection && !has_selected && (facts.classes || facts.mask_coefficients == 0);
    case OutputLayout::kObb:
      return facts.task == "obb" && !has_selected;
    case OutputLayout::kSegment:
      return (facts.task.empty() || facts.task == "segment") && !has_selected;
    case OutputLayout::kPose:
      return facts.task == "pose" && !facts.has_selected.value_or(!is_longer_than_wide);
    case OutputLayout::kEnd2end:
      return facts.has_selected.value_or(is_few && is_longer_than_wide) && !facts.is_rtdetr.value_or(false);
    case OutputLayout::kRtdetr:
      return is_detection && !has_selected && is_few && facts.classes && facts.is_rtdetr.value_or(true);
    case OutputLayout::kRtdetrTop:
      return is_detection && !has_selected && is_few && facts.is_rtdetr.value_or(false);
    case OutputLayout::kYolov5:
      return is_detection && !has_selected && form.candidates == kAnchorsPerCell * cells;
    default:  // YOLOX cannot be told from others
      return false;
  }
}

}  // namespace

std::vector<OutputForm> possible_forms(const OutputFacts& facts, OutputLayout wanted) {
  std::vector<OutputForm> forms;
  for (const OutputLayout layout : kLayouts) {
    if (wanted != OutputLayout::kAuto && layout != wanted) continue;
    const auto form = form_of(layout, facts);
    if (form && (wanted != OutputLayout::kAuto || is_plausible(*form, facts))) forms.push_back(*form);
  }
  return forms;
}

bool lists_candidates_last(OutputLayout layout) {
  return layout == OutputLayout::kYolo11 || layout == OutputLayout::kObb ||
         layout == OutputLayout::kSegment || layout == OutputLayout::kPose;
}

bool needs_no_suppression(OutputLayout layout) {
  return layout == OutputLayout::kEnd2end || layout == OutputLayout::kRtdetr ||
         layout == OutputLayout::kRtdetrTop;
}

const char* shape_of(OutputLayout layout) {
  switch (layout) {
    case OutputLayout::kAuto:
      return "[1, ?, ?]";
    case OutputLayout::kYolo11:
      return "[1, 4 + classes, candidates]";
    case OutputLayout::kObb:
      return "[1, 4 + classes + 1, candidates]";
    case OutputLayout::kSegment:
      return "[1, 4 + classes + masks, candidates] beside the masks' prototypes";
    case OutputLayout::kPose:
      return "[1, 4 + classes + key points, candidates]";
    case OutputLayout::kEnd2end:
    case OutputLayout::kRtdetrTop:
      return "[1, candidates, 6]";
    case OutputLayout::kRtdetr:
      return "[1, candidates, 4 + classes]";
    case OutputLayout::kYolov5:
      return "[1, candidates, 5 + classes]";
    case OutputLayout::kYolox:
      return "[1, cells of 8, 16 and 32 px, 5 + classes]";
  }
  return "";
}

std::int64_t grid_cells(ImageSize input) {
  std::int64_t cells = 0;
  for (const int stride_px : kGridStrides_px)
    cells += static_cast<std::int64_t>(input.width_px / stride_px) * (input.height_px / stride_px);
  return cells;
}

}  // namespace geoloc::io
