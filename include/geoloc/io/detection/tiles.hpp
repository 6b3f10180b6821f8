// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// The configuration's grid of overlapping tiles, row by row: all of one size, together the whole picture.
/// Whatever is no longer than the overlap lies in one of them entirely. Where the picture is too small for
/// the overlap it is half a tile.
std::vector<cv::Rect> tiles_of(ImageSize picture, const DetectionConfig& config);

/// Detections of one tile, in the whole picture's pixels.
struct TileDetections {
  cv::Rect tile;
  std::vector<Detection> detections;
};

/// One list of what was found in the tiles and what was found in the picture as a whole, most confident
/// first. What touches an inner edge of its tile is cut off there, and dropped: another tile has it, or the
/// whole picture. Of boxes of a class that overlap (nms_iou) or contain half of one another, the one that
/// stays is, in this order: from the whole picture and longer than the overlap; from a tile; the more
/// confident.
std::vector<Detection> merge_tiles(const std::vector<TileDetections>& in_tiles,
                                   const std::vector<Detection>& in_whole, ImageSize picture,
                                   const DetectionConfig& config);

}  // namespace geoloc::io
