// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/projection/ground_fix.hpp"

namespace geoloc {

/// A latency that is nearer to the one believed is what the solver finds by itself.
inline constexpr double kLeastLatencyChange_s = 0.15;

/// The boxes of a frame, the most confident ones.
struct FrameBoxes {
  static constexpr std::size_t kMost = 16;

  FrameStamp stamp;
  std::array<Eigen::Vector2d, kMost> pixels;
  std::size_t count = 0;
  double share = 1.0;  ///< of the frame's boxes

  FrameBoxes() = default;
  FrameBoxes(FrameStamp frame_stamp, const std::vector<LocatedDetection>& detections,
             std::size_t most = kMost)
      : FrameBoxes(frame_stamp, detections.size(), most,
                   [&](std::size_t i) { return detections[i].detection.box.centre(); }) {}

  /// Of so many boxes, whose centres are centre(0), centre(1)...
  template <typename Centre>
  FrameBoxes(FrameStamp frame_stamp, std::size_t boxes, std::size_t most, const Centre& centre)
      : stamp(frame_stamp), count(std::min(boxes, most)) {
    if (count < boxes) share = static_cast<double>(count) / static_cast<double>(boxes);
    for (std::size_t i = 0; i < count; ++i) pixels[i] = centre(i);
  }
};

/// How many frames before it the one lies that a frame of that time is to be compared with: long enough to
/// turn, short enough to show the same. `before(n)`: the time of the frame n before it; there are so many.
/// nullopt: none is suited.
template <typename Before>
std::optional<std::size_t> frames_to_compare(HostTime frame, std::size_t earlier, const Before& before) {
  constexpr double kLeastApart_s = 0.5, kMostApart_s = 1.2;
  for (std::size_t n = 1; n <= earlier; ++n) {
    const double apart_s = seconds(frame - before(n));
    if (apart_s > kMostApart_s) return std::nullopt;
    if (apart_s >= kLeastApart_s) return n;
  }
  return std::nullopt;
}

}  // namespace geoloc
