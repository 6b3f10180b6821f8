// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/frame_ledger.hpp"

#include <algorithm>

namespace geoloc::io {

void FrameLedger::observe(const RtpPacket& packet, HostTime received_at) {
  if (!last_sequence_)
    damaged_since_ = received_at;  // joined in the middle: damaged until a random access picture
  if (last_sequence_) {
    const auto missing = static_cast<std::uint16_t>(packet.sequence - *last_sequence_ - 1);
    if (missing != 0) note_gap(missing, received_at);
  }
  last_sequence_ = packet.sequence;

  FrameEntry& entry = entry_of(packet.timestamp, received_at);
  if (damaged_since_ && received_at - *damaged_since_ > kHealsWithin) damaged_since_.reset();
  if (packet.begins_random_access_picture) {
    damaged_since_.reset();
    entry.damaged = false;  // parameter sets ahead of it in the same frame may have been marked
  }
  if (damaged_since_) entry.damaged = true;
}

void FrameLedger::note_gap(std::uint16_t missing, HostTime at) {
  constexpr std::uint16_t kRestart = 0x8000;  // the sender restarted: the number of lost packets is unknown
  if (missing < kRestart) lost_packets_ += missing;
  damaged_since_ = at;
  if (frames_ > 0) entries_[(frames_ - 1) % kFrames].damaged = true;
}

FrameEntry& FrameLedger::entry_of(std::uint32_t timestamp, HostTime received_at) {
  if (frames_ == 0 || entries_[(frames_ - 1) % kFrames].timestamp != timestamp) {
    entries_[frames_ % kFrames] = {timestamp, received_at, false};
    ++frames_;
  }
  return entries_[(frames_ - 1) % kFrames];
}

std::optional<FrameEntry> FrameLedger::find(std::uint32_t timestamp) const {
  const std::size_t known = std::min(frames_, kFrames);
  for (std::size_t age = 1; age <= known; ++age) {
    const FrameEntry& entry = entries_[(frames_ - age) % kFrames];
    if (entry.timestamp == timestamp) return entry;
  }
  return std::nullopt;
}

}  // namespace geoloc::io
