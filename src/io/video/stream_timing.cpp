// SPDX-License-Identifier: Apache-2.0
#include "stream_timing.hpp"

namespace geoloc::io {

std::uint64_t StreamTiming::observe(const RtpPacket& packet, HostTime received_at) {
  const std::lock_guard lock{mutex_};
  const std::uint64_t lost_before = ledger_.lost_packets();
  ledger_.observe(packet, received_at);
  return ledger_.lost_packets() - lost_before;
}

void StreamTiming::observe(const SenderReport& report) {
  const std::lock_guard lock{mutex_};
  clock_.observe(report);
}

VideoFrame StreamTiming::stamp(std::optional<std::uint32_t> rtp_timestamp, HostTime decoded_at) {
  const std::lock_guard lock{mutex_};
  const auto entry = rtp_timestamp ? ledger_.find(*rtp_timestamp) : std::nullopt;
  VideoFrame frame;
  if (!entry) {
    frame.received_at = decoded_at;
    frame.captured_at = decoded_at - latency_;
    return frame;
  }
  const auto capture = clock_.capture_time(entry->timestamp, entry->received_at);
  frame.received_at = entry->received_at;
  frame.captured_at = capture.captured_at;
  frame.time_quality = capture.quality;
  frame.damaged = entry->damaged;
  return frame;
}

}  // namespace geoloc::io
