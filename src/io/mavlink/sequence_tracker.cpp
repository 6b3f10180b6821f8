// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/sequence_tracker.hpp"

namespace geoloc::io {
namespace {

/// Frames missing between two sequence numbers, which wrap at 256. A difference of half the range or more is
/// a frame that was overtaken or duplicated: nothing is missing.
std::uint64_t missing_between(std::uint8_t before, std::uint8_t after) {
  const auto missing = static_cast<std::uint8_t>(after - before - 1);
  return missing < 128 ? missing : 0;
}

}  // namespace

std::optional<std::size_t> SequenceTracker::find(MavAddress address) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (senders_[i].address == address) return i;
  }
  return std::nullopt;
}

void SequenceTracker::observe(MavAddress sender, std::uint8_t sequence) {
  if (!find(sender) && count_ < kSenders) {
    senders_[count_++] = {sender, sequence, 0};
  } else {
    observe_unchecked(sender, sequence);
  }
}

void SequenceTracker::observe_unchecked(MavAddress sender, std::uint8_t sequence) {
  const auto found = find(sender);
  if (!found) return;
  Sender& known = senders_[*found];
  known.lost += missing_between(known.sequence, sequence);
  known.sequence = sequence;
}

std::uint64_t SequenceTracker::lost(MavAddress sender) const {
  const auto found = find(sender);
  return found ? senders_[*found].lost : 0;
}

std::uint64_t SequenceTracker::lost() const {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < count_; ++i) total += senders_[i].lost;
  return total;
}

}  // namespace geoloc::io
