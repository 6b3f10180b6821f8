// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/sequence_tracker.hpp"

namespace geoloc::io {
namespace {

/// Frames missing between two sequence numbers, which wrap at 256. Half a turn or more is a frame that was
/// overtaken or came twice: nothing is missing.
std::uint64_t missing_between(std::uint8_t before, std::uint8_t after) {
  const auto missing = static_cast<std::uint8_t>(after - before - 1);
  return missing < 128 ? missing : 0;
}

}  // namespace

SequenceTracker::Sender* SequenceTracker::find(MavAddress address) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (senders_[i].address == address) return &senders_[i];
  }
  return nullptr;
}

void SequenceTracker::observe(MavAddress sender, std::uint8_t sequence) {
  if (find(sender) == nullptr && count_ < kSenders) {
    senders_[count_++] = {sender, sequence, 0};
    return;
  }
  observe_unchecked(sender, sequence);
}

void SequenceTracker::observe_unchecked(MavAddress sender, std::uint8_t sequence) {
  Sender* const known = find(sender);
  if (known == nullptr) return;
  known->lost += missing_between(known->sequence, sequence);
  known->sequence = sequence;
}

std::uint64_t SequenceTracker::lost(MavAddress sender) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (senders_[i].address == sender) return senders_[i].lost;
  }
  return 0;
}

std::uint64_t SequenceTracker::lost() const {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < count_; ++i) total += senders_[i].lost;
  return total;
}

}  // namespace geoloc::io
