// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_decode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "boxes.hpp"

namespace geoloc::io {
namespace {

/// Rounding in a network may lift a sigmoid over 1 by this much.
constexpr double kScoreTolerance = 1e-3;

class Values {
 public:
  explicit Values(const YoloOutput& output) : output_(output) {}

  double operator()(int row, int candidate) const {
    return output_.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(output_.candidates) +
                          static_cast<std::size_t>(candidate)];
  }

 private:
  const YoloOutput& output_;
};

/// The best class of each candidate, computed row by row as the scores lie in memory.
struct BestScores {
  std::vector<float> values;
  std::vector<int> class_ids;
};

BestScores best_scores(const YoloOutput& output) {
  const auto candidates = static_cast<std::size_t>(output.candidates);
  const float* row = output.values + YoloOutput::kBoxRows * candidates;
  BestScores best{{row, row + candidates}, std::vector<int>(candidates, 0)};
  for (int class_id = 1; class_id < output.classes; ++class_id) {
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

/// The box in the network's input; nullopt if it is impossible.
std::optional<Box> box_of(const YoloOutput& output, int candidate) {
  const Values values{output};
  const double width = values(2, candidate);
  const double height = values(3, candidate);
  const Box box{values(0, candidate) - 0.5 * width, values(1, candidate) - 0.5 * height, width, height};
  if (!(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(width) && std::isfinite(height)))
    return std::nullopt;
  if (!(width > 0 && height > 0)) return std::nullopt;
  return box;
}

DecodedBoxes confident_boxes(const YoloOutput& output, double threshold) {
  DecodedBoxes found;
  const BestScores best = best_scores(output);
  for (int candidate = 0; candidate < output.candidates; ++candidate) {
    const double score = best.values[static_cast<std::size_t>(candidate)];
    if (score < threshold) {
      found.best_score_below = std::max(found.best_score_below, score);
      continue;
    }
    const auto box = box_of(output, candidate);
    if (!box || !(score <= 1 + kScoreTolerance)) {
      ++found.rejected;
      continue;
    }
    found.detections.push_back(
        {*box, std::min(score, 1.0), best.class_ids[static_cast<std::size_t>(candidate)]});
  }
  return found;
}

/// The sigma in pixels of the picture.
double sigma_px(const Box& in_input, const Box& in_picture, ImageSize picture, const CentreSigma& sigma) {
  const double size_px = std::sqrt(in_input.width * in_input.height);
  const double picture_per_input = std::sqrt(in_picture.width * in_picture.height) / size_px;
  const double in_picture_px = std::hypot(sigma.constant_px, sigma.of_size * size_px) * picture_per_input;
  return stated_sigma_px(in_picture_px, in_picture, picture);
}

}  // namespace

double intersection_over_union(const Box& a, const Box& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (!(width > 0 && height > 0)) return 0.0;
  const double intersection = width * height;
  return intersection / (a.width * a.height + b.width * b.height - intersection);
}

DecodedBoxes decode_yolo(const YoloOutput& output, const Letterbox& letterbox, ImageSize picture,
                         const DetectionConfig& config, const std::optional<CentreSigma>& sigma) {
  DecodedBoxes decoded = confident_boxes(output, config.confidence);
  const std::vector<Detection> in_input = suppress_overlaps(std::move(decoded.detections), config);
  decoded.detections.clear();
  for (const Detection& detection : in_input) {
    const Box whole = letterbox.to_picture(detection.box);
    const auto box = clipped(whole, picture);
    if (!box) continue;
    decoded.detections.push_back({*box, detection.confidence, detection.class_id,
                                  sigma ? sigma_px(detection.box, whole, picture, *sigma) : 0.0});
  }
  return decoded;
}

}  // namespace geoloc::io
