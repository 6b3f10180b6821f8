// SPDX-License-Identifier: Apache-2.0
#include "common/run_census.hpp"

#include <algorithm>

namespace geoloc::apps {
namespace {

void extend(std::optional<HostTimeSpan>& span, HostTime to) {
  if (!span) span = HostTimeSpan{to, to};
  span->first = std::min(span->first, to);
  span->last = std::max(span->last, to);
}

bool ends_beyond(const Box& box, const CameraIntrinsics& image) {
  constexpr double kTolerance_px = 2.0;  // detectors round
  return box.x + box.width > image.width_px + kTolerance_px ||
         box.y + box.height > image.height_px + kTolerance_px;
}

void note_box(RunCensus& census, const Box& box, const CameraIntrinsics& image) {
  ++census.boxes;
  if (box.width <= 1.0 && box.height <= 1.0) ++census.boxes_within_a_pixel;
  if (ends_beyond(box, image)) ++census.boxes_beyond_image;
  if (box.width > box.x && box.height > box.y) ++census.boxes_like_corners;
}

}  // namespace

void note_telemetry(RunCensus& census, HostTime received_at) {
  extend(census.telemetry, received_at);
}

void note_frame(RunCensus& census, HostTime captured_at, const std::vector<Detection>& detections,
                const CameraIntrinsics& image) {
  extend(census.frames, captured_at);
  ++census.frame_count;
  for (const Detection& detection : detections) note_box(census, detection.box, image);
}

}  // namespace geoloc::apps
