// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "geoloc/io/encoded_video.hpp"

namespace geoloc::io {

/// Holds a video back until it is known what its pictures show, so that the metadata of a picture can be
/// written beside it. Thread-safe.
class HeldVideo final : public EncodedVideoTaker {
 public:
  using Pictures = std::vector<EncodedPicture>;

  void add(EncodedPicture picture) override;
  void note_frame(HostTime captured_at, Duration shown_at) override;

  /// When the frame of that capture time is shown; nullopt where it is of none of the last minute's pictures.
  std::optional<Duration> shown_at(HostTime captured_at) const;

  /// Takes all that come before the picture shown then, in the order of decoding, and that one.
  Pictures take_through(Duration shown_at);

  /// Takes those that were decoded kLongestHold ago: nobody will say what they show.
  Pictures take_overdue();

  Pictures take_all();

  /// Pictures that are lost, since too many were held; since the last call.
  std::uint64_t take_lost();

  static constexpr Duration kLongestHold = std::chrono::seconds{2};
  static constexpr std::size_t kMostHeld_bytes = 64U << 20U;

 private:
  struct Frame {
    HostTime captured_at;
    Duration shown_at;
  };

  Pictures take_first(std::size_t count);

  mutable std::mutex mutex_;
  std::deque<EncodedPicture> pictures_;
  std::size_t held_bytes_ = 0;
  std::uint64_t lost_ = 0;
  std::deque<Frame> frames_;
};

}  // namespace geoloc::io
