// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_decode.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boxes.hpp"
#include "candidates.hpp"

namespace geoloc::io {
namespace {

/// Rounding in a network may lift a sigmoid over 1 by this much.
constexpr double kScoreTolerance = 1e-3;

struct Found {
  std::vector<OutlinedDetection> in_input;
  std::size_t rejected = 0;
  double best_score_below = 0.0;
};

Found confident_boxes(const YoloOutput& output, ImageSize input, double threshold) {
  Found found;
  const BestScores best = best_scores(output);
  for (int candidate = 0; candidate < output.form.candidates; ++candidate) {
    const double score = best.values[static_cast<std::size_t>(candidate)];
    const int class_id = best.class_ids[static_cast<std::size_t>(candidate)];
    if (score < threshold) {
      found.best_score_below = std::max(found.best_score_below, score);
      continue;
    }
    const auto outline = outline_of(output, input, candidate);
    if (!outline || class_id < 0 || !(score <= 1 + kScoreTolerance)) {
      ++found.rejected;
      continue;
    }
    found.in_input.push_back({{outline->upright, std::min(score, 1.0), class_id}, outline->rotated});
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

DecodedBoxes decode_yolo(const YoloOutput& output, const Letterbox& letterbox, ImageSize input,
                         ImageSize picture, const DetectionConfig& config,
                         const std::optional<CentreSigma>& sigma) {
  Found found = confident_boxes(output, input, config.confidence);
  const std::vector<OutlinedDetection> kept = needs_no_suppression(output.form.layout)
                                                  ? most_confident(std::move(found.in_input), config)
                                                  : suppress_overlaps(std::move(found.in_input), config);
  DecodedBoxes decoded{{}, found.rejected, found.best_score_below};
  for (const OutlinedDetection& detection : kept) {
    const Box whole = letterbox.to_picture(detection.box);
    const auto box = clipped(whole, picture);
    if (!box) continue;
    decoded.detections.push_back({*box, detection.confidence, detection.class_id,
                                  sigma ? sigma_px(detection.box, whole, picture, *sigma) : 0.0});
  }
  return decoded;
}

}  // namespace geoloc::io
