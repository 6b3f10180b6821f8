// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/held_video.hpp"

#include <algorithm>
#include <iterator>

namespace geoloc::io {
namespace {

constexpr std::size_t kMostFrames = 60 * 60;  // a minute at 60 per second

}  // namespace

void HeldVideo::add(EncodedPicture picture) {
  const std::lock_guard lock(mutex_);
  held_bytes_ += picture.bytes.size();
  pictures_.push_back(std::move(picture));
  while (held_bytes_ > kMostHeld_bytes) lost_ += take_first(1).size();
}

void HeldVideo::note_frame(HostTime captured_at, Duration shown_at) {
  const std::lock_guard lock(mutex_);
  frames_.push_back({captured_at, shown_at});
  if (frames_.size() > kMostFrames) frames_.pop_front();
}

std::optional<Duration> HeldVideo::shown_at(HostTime captured_at) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(frames_.rbegin(), frames_.rend(), [captured_at](const Frame& frame) {
    return frame.captured_at == captured_at;
  });
  if (found == frames_.rend()) return std::nullopt;
  return found->shown_at;
}

/// The last one counts that is shown by then: pictures between are decoded before it.
HeldVideo::Pictures HeldVideo::take_through(Duration shown_at) {
  const std::lock_guard lock(mutex_);
  const auto last =
      std::find_if(pictures_.rbegin(), pictures_.rend(),
                   [shown_at](const EncodedPicture& picture) { return picture.shown_at <= shown_at; });
  return take_first(static_cast<std::size_t>(std::distance(last, pictures_.rend())));
}

HeldVideo::Pictures HeldVideo::take_overdue() {
  std::optional<Duration> newest;
  {
    const std::lock_guard lock(mutex_);
    if (!frames_.empty()) newest = frames_.back().shown_at;
  }
  return newest ? take_through(*newest - kLongestHold) : Pictures{};
}

HeldVideo::Pictures HeldVideo::take_all() {
  const std::lock_guard lock(mutex_);
  return take_first(pictures_.size());
}

std::uint64_t HeldVideo::take_lost() {
  const std::lock_guard lock(mutex_);
  return std::exchange(lost_, 0);
}

HeldVideo::Pictures HeldVideo::take_first(std::size_t count) {
  const auto end = pictures_.begin() + static_cast<std::ptrdiff_t>(count);
  Pictures taken(std::make_move_iterator(pictures_.begin()), std::make_move_iterator(end));
  pictures_.erase(pictures_.begin(), end);
  for (const EncodedPicture& picture : taken) held_bytes_ -= picture.bytes.size();
  return taken;
}

}  // namespace geoloc::io
