// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/kept_frame.hpp"

namespace geoloc {

/// Whether a frame was captured before another: after a step of the vehicle's clock, all are later.
bool is_before(const KeptFrame& a, const KeptFrame& b);

/// Frames that wait for telemetry, in order of their times. Does not allocate after construction.
class FrameQueue {
 public:
  static constexpr std::size_t kMost = 64;

  explicit FrameQueue(int max_detections) : frames_(kMost, KeptFrame(0)) {
    for (std::size_t i = 0; i < kMost; ++i) {
      frames_[i].detections.reserve(static_cast<std::size_t>(max_detections));
      order_[i] = static_cast<std::uint8_t>(i);
    }
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
