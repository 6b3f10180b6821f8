// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "geoloc/io/detection/yolo_decode.hpp"

namespace geoloc::io {
namespace {

struct Span {
  int begin_px = 0;
  int length_px = 0;
};

/// `count` spans of one length that cover [0, length_px).
std::vector<Span> spans(int length_px, int count, int overlap_px) {
  const int tiles = std::min(count, length_px);  // of at least one pixel each
  // Overlaps of more than half a tile would cover the same three times.
  const int overlap = std::min(overlap_px, length_px / (tiles + 1));
  const int span_px = (length_px + (tiles - 1) * overlap + tiles - 1) / tiles;
  std::vector<Span> all;
  for (int i = 0; i < tiles; ++i) {
    const double share = tiles > 1 ? static_cast<double>(i) / (tiles - 1) : 0.0;
    all.push_back({static_cast<int>(std::floor(share * (length_px - span_px))), span_px});
  }
  return all;
}

/// Whether the box touches an edge of its tile where the picture continues.
bool is_cut(const Box& box, const cv::Rect& tile, ImageSize picture) {
  constexpr double kNear_px = 2.0;
  return (tile.x > 0 && box.x < tile.x + kNear_px) || (tile.y > 0 && box.y < tile.y + kNear_px) ||
         (tile.br().x < picture.width_px && box.x + box.width > tile.br().x - kNear_px) ||
         (tile.br().y < picture.height_px && box.y + box.height > tile.br().y - kNear_px);
}

double share_of_smaller(const Box& a, const Box& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (!(width > 0 && height > 0)) return 0.0;
  return width * height / std::min(a.width * a.height, b.width * b.height);
}

/// A detection and where it was found.
struct Find {
  Detection detection;
  int rank = 0;            ///< the lower one stays
  std::size_t source = 0;  ///< boxes of one source were compared by the detector already
};

bool is_one_object(const Find& a, const Find& b, double nms_iou) {
  constexpr double kContained = 0.5;
  if (a.source == b.source || a.detection.class_id != b.detection.class_id) return false;
  return intersection_over_union(a.detection.box, b.detection.box) > nms_iou ||
         share_of_smaller(a.detection.box, b.detection.box) > kContained;
}

std::vector<Find> all_finds(const std::vector<TileDetections>& in_tiles,
                            const std::vector<Detection>& in_whole, ImageSize picture, int overlap_px) {
  std::vector<Find> finds;
  for (const Detection& detection : in_whole) {
    const bool is_long = std::max(detection.box.width, detection.box.height) > overlap_px;
    finds.push_back({detection, is_long ? 0 : 2, 0});
  }
  for (std::size_t i = 0; i < in_tiles.size(); ++i) {
    for (const Detection& detection : in_tiles[i].detections) {
      if (!is_cut(detection.box, in_tiles[i].tile, picture)) finds.push_back({detection, 1, i + 1});
    }
  }
  std::stable_sort(finds.begin(), finds.end(), [](const Find& a, const Find& b) {
    return std::make_tuple(a.rank, -a.detection.confidence) <
           std::make_tuple(b.rank, -b.detection.confidence);
  });
  return finds;
}

}  // namespace

std::vector<cv::Rect> tiles_of(ImageSize picture, const DetectionConfig& config) {
  std::vector<cv::Rect> tiles;
  for (const Span& row : spans(picture.height_px, config.tile_rows, config.tile_overlap_px)) {
    for (const Span& column : spans(picture.width_px, config.tile_columns, config.tile_overlap_px))
      tiles.emplace_back(column.begin_px, row.begin_px, column.length_px, row.length_px);
  }
  return tiles;
}

std::vector<Detection> merge_tiles(const std::vector<TileDetections>& in_tiles,
                                   const std::vector<Detection>& in_whole, ImageSize picture,
                                   const DetectionConfig& config) {
  std::vector<Find> kept;
  for (const Find& find : all_finds(in_tiles, in_whole, picture, config.tile_overlap_px)) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Find& other) {
      return is_one_object(find, other, config.nms_iou);
    });
    if (!is_known) kept.push_back(find);
  }
  std::vector<Detection> merged;
  for (const Find& find : kept) merged.push_back(find.detection);
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Detection& a, const Detection& b) { return a.confidence > b.confidence; });
  if (merged.size() > static_cast<std::size_t>(config.max_detections))
    merged.resize(static_cast<std::size_t>(config.max_detections));
  return merged;
}

}  // namespace geoloc::io
