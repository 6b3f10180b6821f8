// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// The configuration's grid of overlapping tiles, row by row: all of one size, together covering the whole
/// picture. Whatever is no longer than the overlap lies entirely within one of them. If the picture is too
/// small for that overlap, the overlap is half a tile.
std::vector<cv::Rect> tiles_of(ImageSize picture, const DetectionConfig& config);

/// Detections of one tile, in the whole picture's pixels.
struct TileDetections {
  cv::Rect tile;
  std::vector<Detection> detections;
};

/// Merges the detections of the tiles and those of the whole picture, most confident first. A box that
/// touches an inner edge of its tile is cut off there and dropped, because another tile or the whole picture
/// has it whole. Where boxes of a class overlap (nms_iou) or contain half of one another, the one that is
/// kept is, in this order: one from the whole picture that is longer than the overlap; one from a tile; the
/// more confident one.
std::vector<Detection> merge_tiles(const std::vector<TileDetections>& in_tiles,
                                   const std::vector<Detection>& in_whole, ImageSize picture,
                                   const DetectionConfig& config);

}  // namespace geoloc::io
