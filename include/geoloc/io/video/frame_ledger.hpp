// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

struct RtpPacket {
  std::uint16_t sequence = 0;
  std::uint32_t timestamp = 0;
  bool begins_random_access_picture = false;
};

/// What was learnt about a frame from its packets.
struct FrameEntry {
  std::uint32_t timestamp = 0;
  HostTime received_at;  ///< of its first packet
  bool damaged = false;
};

/// Follows the packets of a stream and remembers the last frames by their RTP timestamp until they come out
/// of the decoder. A gap in the sequence numbers damages the frame before it (its end may be missing), the
/// frame after it, and all that follow up to a random access picture: one lost packet in a thousand spoils
/// most frames of a stream, and no decoder says so.
class FrameLedger {
 public:
  void observe(const RtpPacket& packet, HostTime received_at);

  /// nullopt where that frame is unknown or long past.
  std::optional<FrameEntry> find(std::uint32_t timestamp) const;

  std::uint64_t lost_packets() const { return lost_packets_; }

  /// Streams refreshed slice by slice have no random access pictures: after this long without loss, frames
  /// count as undamaged again.
  static constexpr Duration kHealsWithin = std::chrono::seconds{10};

 private:
  static constexpr std::size_t kFrames = 128;  // more than a decoder holds back

  void note_gap(std::uint16_t missing, HostTime at);
  FrameEntry& entry_of(std::uint32_t timestamp, HostTime received_at);

  std::array<FrameEntry, kFrames> entries_{};
  std::size_t frames_ = 0;  // ever seen; the newest is at (frames_ - 1) % kFrames
  std::optional<std::uint16_t> last_sequence_;
  std::optional<HostTime> damaged_since_;
  std::uint64_t lost_packets_ = 0;
};

}  // namespace geoloc::io
