// SPDX-License-Identifier: Apache-2.0
#include "candidates.hpp"

#include <cmath>
#include <limits>

namespace geoloc::io {
namespace {

constexpr std::size_t kBoxValues = 4;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// The numbers of one candidate.
class Candidate {
 public:
  Candidate(const YoloOutput& output, std::size_t index)
      : first_(output.values +
               (lists_candidates_last(output.form.layout) ? index : index * count(output.form.values))),
        stride_(lists_candidates_last(output.form.layout) ? count(output.form.candidates) : 1) {}

  float operator[](std::size_t i) const { return first_[i * stride_]; }

 private:
  static std::size_t count(int number) { return static_cast<std::size_t>(number); }

  const float* first_;
  std::size_t stride_;
};

/// Row by row, as the scores lie in memory.
BestScores best_of_rows(const YoloOutput& output) {
  const auto candidates = static_cast<std::size_t>(output.form.candidates);
  const float* row = output.values + kBoxValues * candidates;
  BestScores best{{row, row + candidates}, std::vector<int>(candidates, 0)};
  for (int class_id = 1; class_id < output.form.classes; ++class_id) {
    row += candidates;
    for (std::size_t i = 0; i < candidates; ++i) {
      const bool is_better =
          !(row[i] <= best.values[i]) && !std::isnan(best.values[i]);  // NaN wins, and stays
      best.class_ids[i] = is_better ? class_id : best.class_ids[i];
      best.values[i] = is_better ? row[i] : best.values[i];
    }
  }
  return best;
}

struct BestClass {
  float score;
  int class_id;
};

/// The best of the scores from the value `first` on.
BestClass best_class(const Candidate& candidate, std::size_t first, int classes) {
  BestClass best{candidate[first], 0};
  for (int class_id = 1; class_id < classes; ++class_id) {
    const float score = candidate[first + static_cast<std::size_t>(class_id)];
    if (!(score <= best.score) && !std::isnan(best.score)) best = {score, class_id};
  }
  return best;
}

/// The class that the network names after the score.
BestClass named_class(const Candidate& candidate, int classes) {
  const float score = candidate[kBoxValues], number = candidate[kBoxValues + 1];
  const bool is_class = number >= 0 && number < static_cast<float>(classes) && std::trunc(number) == number;
  return {std::isnan(number) ? kNaN : score, is_class ? static_cast<int>(number) : -1};
}

BestClass best_class(const YoloOutput& output, const Candidate& candidate) {
  switch (output.form.layout) {
    case OutputLayout::kEnd2end:
    case OutputLayout::kRtdetrTop:
      return named_class(candidate, output.form.classes);
    case OutputLayout::kYolov5:
    case OutputLayout::kYolox: {
      const BestClass best = best_class(candidate, kBoxValues + 1, output.form.classes);
      return {best.score * candidate[kBoxValues], best.class_id};
    }
    default:
      return best_class(candidate, kBoxValues, output.form.classes);
  }
}

struct Place {
  int column, row, stride_px;
};

/// The cell that a candidate of YOLOX belongs to.
Place cell_of(int candidate, ImageSize input) {
  for (const int stride_px : kGridStrides_px) {
    const int columns = input.width_px / stride_px, cells = columns * (input.height_px / stride_px);
    if (candidate < cells) return {candidate % columns, candidate / columns, stride_px};
    candidate -= cells;
  }
  return {0, 0, 0};
}

/// Centre x, y, width and height in the network's input.
RotatedBox centred_box(const YoloOutput& output, const Candidate& candidate, ImageSize input, int index) {
  const double a = candidate[0], b = candidate[1], c = candidate[2], d = candidate[3];
  switch (output.form.layout) {
    case OutputLayout::kRtdetr:
    case OutputLayout::kRtdetrTop:
      return {a * input.width_px, b * input.height_px, c * input.width_px, d * input.height_px};
    case OutputLayout::kYolox: {
      const auto [column, row, stride_px] = cell_of(index, input);
      return {(a + column) * stride_px, (b + row) * stride_px, std::exp(c) * stride_px,
              std::exp(d) * stride_px};
    }
    default:
      return {a, b, c, d};
  }
}

bool has_corners(const OutputForm& form) {
  return form.layout == OutputLayout::kEnd2end && !form.is_rotated;
}

bool is_possible(const Box& box) {
  return std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) &&
         std::isfinite(box.height) && box.width > 0 && box.height > 0;
}

}  // namespace

BestScores best_scores(const YoloOutput& output) {
  if (lists_candidates_last(output.form.layout)) return best_of_rows(output);
  BestScores best;
  for (int i = 0; i < output.form.candidates; ++i) {
    const BestClass of_candidate = best_class(output, Candidate{output, static_cast<std::size_t>(i)});
    best.values.push_back(of_candidate.score);
    best.class_ids.push_back(of_candidate.class_id);
  }
  return best;
}

std::optional<Outline> outline_of(const YoloOutput& output, ImageSize input, int candidate) {
  const Candidate values{output, static_cast<std::size_t>(candidate)};
  if (has_corners(output.form)) {
    const double left = values[0], top = values[1];
    const Box box{left, top, values[2] - left, values[3] - top};
    return is_possible(box) ? std::optional{Outline{box}} : std::nullopt;
  }
  RotatedBox box = centred_box(output, values, input, candidate);
  const Box level{box.centre_x - 0.5 * box.width, box.centre_y - 0.5 * box.height, box.width, box.height};
  if (!is_possible(level)) return std::nullopt;
  if (!output.form.is_rotated) return Outline{level};
  box.angle_rad = values[static_cast<std::size_t>(output.form.values) - 1];
  const Box upright = upright_around(box);
  return is_possible(upright) ? std::optional{Outline{upright, box}} : std::nullopt;
}

}  // namespace geoloc::io
