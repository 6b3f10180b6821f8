// SPDX-License-Identifier: Apache-2.0
#include "boxes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geoloc/io/detection/yolo_decode.hpp"

namespace geoloc::io {
namespace {

/// Suppression compares pairs, so a faulty network must not give it tens of thousands of boxes.
constexpr std::size_t kMaxCandidates = 2000;

bool is_inside(const Box& box, ImageSize picture) {
  return box.x >= 0.0 && box.y >= 0.0 && box.x + box.width <= picture.width_px &&
         box.y + box.height <= picture.height_px;
}

double overlap(const Detection& a, const Detection& b) {
  return intersection_over_union(a.box, b.box);
}

double overlap(const OutlinedDetection& a, const OutlinedDetection& b) {
  return a.rotated && b.rotated ? probabilistic_overlap(*a.rotated, *b.rotated)
                                : intersection_over_union(a.box, b.box);
}

template <typename Found>
void sort_by_confidence(std::vector<Found>& boxes, std::size_t most) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const Found& a, const Found& b) { return a.confidence > b.confidence; });
  if (boxes.size() > most) boxes.resize(most);
}

template <typename Found>
std::vector<Found> without_overlaps(std::vector<Found> boxes, const DetectionConfig& config) {
  sort_by_confidence(boxes, kMaxCandidates);
  std::vector<Found> kept;
  for (const Found& box : boxes) {
    if (kept.size() >= static_cast<std::size_t>(config.max_detections)) break;
    const bool overlaps = std::any_of(kept.begin(), kept.end(), [&](const Found& other) {
      return other.class_id == box.class_id && overlap(other, box) > config.nms_iou;
    });
    if (!overlaps) kept.push_back(box);
  }
  return kept;
}

}  // namespace

std::vector<Detection> suppress_overlaps(std::vector<Detection> boxes, const DetectionConfig& config) {
  return without_overlaps(std::move(boxes), config);
}

std::vector<OutlinedDetection> suppress_overlaps(std::vector<OutlinedDetection> boxes,
                                                 const DetectionConfig& config) {
  return without_overlaps(std::move(boxes), config);
}

std::vector<OutlinedDetection> most_confident(std::vector<OutlinedDetection> boxes,
                                              const DetectionConfig& config) {
  sort_by_confidence(boxes, static_cast<std::size_t>(config.max_detections));
  return boxes;
}

std::optional<Box> clipped(const Box& box, ImageSize picture) {
  const double left = std::clamp(box.x, 0.0, static_cast<double>(picture.width_px));
  const double right = std::clamp(box.x + box.width, 0.0, static_cast<double>(picture.width_px));
  const double top = std::clamp(box.y, 0.0, static_cast<double>(picture.height_px));
  const double bottom = std::clamp(box.y + box.height, 0.0, static_cast<double>(picture.height_px));
  if (!(right > left && bottom > top)) return std::nullopt;
  return Box{left, top, right - left, bottom - top};
}

double stated_sigma_px(double sigma_px, const Box& whole, ImageSize picture) {
  if (!is_inside(whole, picture) || !std::isfinite(sigma_px)) return 0.0;
  return std::clamp(sigma_px, kSmallestSigma_px, kLargestSigma_px);
}

}  // namespace geoloc::io
