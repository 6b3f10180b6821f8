// SPDX-License-Identifier: Apache-2.0
#include "pipeline/frame_queue.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace geoloc {

bool is_before(const KeptFrame& a, const KeptFrame& b) {
  return std::tie(a.clock_epoch, a.stamp.captured_at) < std::tie(b.clock_epoch, b.stamp.captured_at);
}

void FrameQueue::remove_earliest() {
  std::rotate(order_.begin(), order_.begin() + 1, order_.begin() + static_cast<std::ptrdiff_t>(size_));
  --size_;
}

/// Frames of the same time stay in the order in which they came.
void FrameQueue::insert(KeptFrame& frame) {
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(size_);
  std::swap(frames_[*end], frame);
  const auto place = std::upper_bound(order_.begin(), end, *end, [this](std::uint8_t a, std::uint8_t b) {
    return is_before(frames_[a], frames_[b]);
  });
  std::rotate(place, end, end + 1);
  ++size_;
}

}  // namespace geoloc
