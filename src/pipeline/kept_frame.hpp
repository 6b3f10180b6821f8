// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geometry/room.hpp"

namespace geoloc {

/// What is kept of a frame: its stamp, and those of its detections that are used.
struct KeptFrame {
  FrameStamp stamp;
  std::uint64_t clock_epoch = 0;      ///< StateProvider's, when the frame came
  std::vector<Detection> detections;  ///< whatever order they were listed in: the most confident first
  std::uint64_t dropped = 0;          ///< beyond max_detections, or with numbers that cannot be
  std::uint64_t at_edge = 0;          ///< cut by the image's edge, perhaps

  /// Room for that many detections.
  explicit KeptFrame(int max_detections) { take_room(this, max_detections); }
  /// geometry/room.hpp
  static std::size_t take_room(KeptFrame* self, int max_detections) {
    return room::reserve(self, &KeptFrame::detections, max_detections);
  }

  /// Does not allocate where there is room for config.max_detections.
  void take(const FrameDetections& frame, const GeolocatorConfig& config);
};

}  // namespace geoloc
