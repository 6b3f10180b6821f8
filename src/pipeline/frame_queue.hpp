// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/room.hpp"
#include "pipeline/kept_frame.hpp"

namespace geoloc {

/// Whether a frame was captured before another: after a step of the vehicle's clock, all are later.
bool is_before(const KeptFrame& a, const KeptFrame& b);

/// Frames that wait for telemetry, in order of their times. Does not allocate after construction.
class FrameQueue {
 public:
  static constexpr std::size_t kMost = 64;

  explicit FrameQueue(int max_detections) {
    take_room(this, max_detections);
    for (std::size_t i = 0; i < kMost; ++i) order_[i] = static_cast<std::uint8_t>(i);
  }
  /// geometry/room.hpp
  static std::size_t take_room(FrameQueue* self, int max_detections) {
    const std::size_t bytes = room::reserve(self, &FrameQueue::frames_, kMost);
    for (std::size_t i = 0; self != nullptr && i < kMost; ++i) self->frames_.emplace_back(max_detections);
    return bytes + kMost * KeptFrame::take_room(nullptr, max_detections);
  }

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == kMost; }

  /// There must be one.
  const KeptFrame& earliest() const { return frames_[order_[0]]; }
  const KeptFrame& latest() const { return frames_[order_[size_ - 1]]; }
  void remove_earliest();
  void remove_latest() { --size_; }

  /// There must be room. The frame is swapped with one that has as much room.
  void insert(KeptFrame& frame);

 private:
  std::vector<KeptFrame> frames_;
  std::array<std::uint8_t, kMost> order_{};  // places of the frames, then those of the unused ones
  std::size_t size_ = 0;
};

}  // namespace geoloc
