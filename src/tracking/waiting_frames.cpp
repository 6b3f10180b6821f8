// SPDX-License-Identifier: Apache-2.0
#include "tracking/waiting_frames.hpp"

#include <algorithm>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// Fifteen detections in each frame.
constexpr std::size_t kFullFrames = 32;
constexpr std::size_t kLeastDetections = 8000;

}  // namespace

WaitingFrames::WaitingFrames(int max_detections) : max_detections_(static_cast<std::size_t>(max_detections)) {
  take_room(this, max_detections_);
}

std::size_t WaitingFrames::take_room(WaitingFrames* self, std::size_t max_detections) {
  return room::resize(self, &WaitingFrames::entries_, kMost) +
         room::resize(self, &WaitingFrames::detections_,
                      std::max(kLeastDetections, kFullFrames * max_detections)) +
         room::reserve(self, &WaitingFrames::located_, max_detections);
}

bool WaitingFrames::is_full() const {
  return count_ == entries_.size() || detection_count_ + max_detections_ > detections_.size();
}

bool WaitingFrames::make_room() {
  while (is_full() && used_ > 0) drop_oldest();
  return !is_full();
}

void WaitingFrames::drop_used() {
  while (used_ > 0) drop_oldest();
}

void WaitingFrames::add(const LocatedFrame& frame, bool is_held) {
  held_ = is_held ? held_ + 1 : 0;
  entries_[(begin_ + count_) % entries_.size()] = {frame.stamp, frame.range_m, detection_end_,
                                                   frame.detections.size()};
  ++count_;
  for (const LocatedDetection& located : frame.detections) {
    detections_[detection_end_] = located.detection;
    detection_end_ = (detection_end_ + 1) % detections_.size();
    ++detection_count_;
  }
}

std::optional<LocatedFrame> WaitingFrames::use_next(const LocatedFrame& newest,
                                                    const SharedErrorEstimate& errors) {
  const Entry& next = entry(used_++);
  held_ = std::min(held_, count_ - used_);
  CalibratedViewer viewer{newest.viewer, newest.projector, errors, false, 0.0};
  const auto level = newest.viewer.nominal_view(next.stamp, errors.calibration.latency_s());
  if (!level) return std::nullopt;
  viewer.terrain_m = newest.ground.height_m(level->enu_from_camera.translation.head<2>());
  view_ = *viewer.at(next.stamp, errors.calibration.latency_s());
  located_.clear();
  for (std::size_t i = 0; i < next.detections; ++i) {
    const Detection& detection = detections_[(next.begin + i) % detections_.size()];
    const auto fix = newest.projector.project(detection.box.centre(), view_);
    if (fix) located_.push_back({detection, *fix});
  }
  return LocatedFrame{located_,   newest.projector, view_,         newest.local_frame,
                      next.stamp, newest.viewer,    newest.ground, next.range_m};
}

FrameBoxes WaitingFrames::boxes(std::size_t i) const {
  const Entry& frame = entry(i);
  return {frame.stamp, frame.detections, FrameBoxes::kMost,
          [&](std::size_t k) { return detections_[(frame.begin + k) % detections_.size()].box.centre(); }};
}

void WaitingFrames::use_again_from(std::size_t first) {
  used_ = first;
  held_ = 0;
  drop_used();
}

void WaitingFrames::drop_oldest() {
  detection_count_ -= entry(0).detections;
  left_at_ = entry(0).stamp.captured_at_host;
  begin_ = (begin_ + 1) % entries_.size();
  --count_;
  --used_;
}

}  // namespace geoloc
