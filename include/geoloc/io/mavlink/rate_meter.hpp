// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// Rate of an event over the last three seconds, in steps of a quarter of a second.
class RateMeter {
 public:
  /// Forgets everything. A rate requested within the window covers the time since then.
  void restart(HostTime now) {
    *this = RateMeter{};
    started_ = slot_of(now);
  }

  void add(HostTime at) {
    Slot& slot = slots_[static_cast<std::size_t>(slot_of(at)) % kSlots];
    if (slot.number != slot_of(at)) slot = {slot_of(at), 0};
    ++slot.count;
  }

  /// Rate over complete slots; the current slot does not count. 0 before the first one is complete.
  double rate_hz(HostTime now) const {
    const std::uint64_t end = slot_of(now);
    const std::uint64_t begin = std::max(started_, end - std::min(end, kWindow));
    if (begin >= end) return 0.0;
    std::uint64_t count = 0;
    for (const Slot& slot : slots_) {
      if (slot.number >= begin && slot.number < end) count += slot.count;
    }
    return static_cast<double>(count) / (static_cast<double>(end - begin) * geoloc::seconds(kSlotLength));
  }

 private:
  static constexpr Duration kSlotLength = std::chrono::milliseconds{250};
  static constexpr std::uint64_t kWindow = 12;
  static constexpr std::size_t kSlots = 16;

  struct Slot {
    std::uint64_t number = 0;  ///< on the host clock, in slot lengths
    std::uint64_t count = 0;
  };

  static std::uint64_t slot_of(HostTime time) {
    return static_cast<std::uint64_t>(std::max(time.time_since_epoch(), Duration::zero()) / kSlotLength);
  }

  std::array<Slot, kSlots> slots_{};
  std::uint64_t started_ = 0;
};

}  // namespace geoloc::io
