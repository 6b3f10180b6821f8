// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/tiled_detector.hpp"

#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/detection/tiles.hpp"

namespace geoloc::io {

TiledDetector::TiledDetector(std::unique_ptr<Detector> detector, const DetectionConfig& config)
    : detector_(std::move(detector)), config_(config) {
  refuse_if_any(config_.problems());
}

std::vector<Detection> TiledDetector::detect(const cv::Mat& bgr) {
  ++counts_.images;
  const DetectorCounts before = detector_->counts();
  const std::vector<Detection> in_whole = detector_->detect(bgr);
  if (detector_->counts().unusable_images > before.unusable_images) {
    ++counts_.unusable_images;
    return {};
  }
  std::vector<TileDetections> in_tiles;
  for (const cv::Rect& tile : tiles_of({bgr.cols, bgr.rows}, config_)) {
    in_tiles.push_back({tile, detector_->detect(bgr(tile))});
    for (Detection& detection : in_tiles.back().detections) {
      detection.box.x += tile.x;
      detection.box.y += tile.y;
    }
  }
  if (detector_->counts().failed_images > before.failed_images) {
    ++counts_.failed_images;
    return {};
  }
  return merge_tiles(in_tiles, in_whole, {bgr.cols, bgr.rows}, config_);
}

DetectorCounts TiledDetector::counts() const {
  DetectorCounts counts = counts_;
  counts.rejected_boxes = detector_->counts().rejected_boxes;
  counts.best_score_below = detector_->counts().best_score_below;
  return counts;
}

}  // namespace geoloc::io
