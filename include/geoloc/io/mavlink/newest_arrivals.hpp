// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// Stamped messages of the last moments, against what those of the last quarter of a minute let expect: when
/// the vehicle's clock stops for a while, all messages are late by as much from then on, which is also what
/// a crowded link looks like.
class NewestArrivals {
 public:
  /// offset: stamp - arrival.
  void add(Duration offset, HostTime received_at);

  /// The largest stamp - arrival of the last kWindow before the newest message: the least delayed.
  std::optional<Duration> largest_offset() const { return largest_offset_; }

  /// Calls `visit` with each message's offset and arrival, within the window.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < count_; ++i) visit(messages_[i].offset, messages_[i].received_at);
  }

  /// For how long all messages have been late.
  struct Lateness {
    HostTime since;
    int messages = 0;
    Duration least{};
    Duration most{};
  };

  /// To be called after add(), with the least delayed of the last quarter of a minute.
  void compare(Duration largest_offset_before, HostTime received_at);

  /// nullopt where some message was in time.
  const std::optional<Lateness>& lateness() const { return lateness_; }

  void clear() { *this = NewestArrivals{}; }

  static constexpr Duration kWindow = std::chrono::milliseconds{300};
  /// Less than this is jitter.
  static constexpr Duration kLeastLateness = std::chrono::milliseconds{100};

 private:
  struct Message {
    Duration offset;
    HostTime received_at;
  };

  std::array<Message, 32> messages_{};
  std::size_t count_ = 0;
  std::optional<Duration> largest_offset_;
  std::optional<Lateness> lateness_;
};

}  // namespace geoloc::io
