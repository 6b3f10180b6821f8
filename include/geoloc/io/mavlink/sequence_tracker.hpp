// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::io {

/// Counts lost frames from the gaps in each sender's sequence numbers. It tracks the first kSenders senders
/// only, so a flood of forged addresses costs nothing.
class SequenceTracker {
 public:
  void observe(MavAddress sender, std::uint8_t sequence);

  /// For frames whose checksum cannot be verified: they fill a gap of a known sender, but do not add a
  /// sender.
  void observe_unchecked(MavAddress sender, std::uint8_t sequence);

  /// Frames lost from one sender; 0 if it is not tracked.
  std::uint64_t lost(MavAddress sender) const;

  /// Frames lost from all senders.
  std::uint64_t lost() const;

 private:
  static constexpr std::size_t kSenders = 32;

  struct Sender {
    MavAddress address;
    std::uint8_t sequence = 0;
    std::uint64_t lost = 0;
  };

  std::optional<std::size_t> find(MavAddress address) const;

  std::array<Sender, kSenders> senders_{};
  std::size_t count_ = 0;
};

}  // namespace geoloc::io
