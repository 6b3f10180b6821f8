// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "geoloc/io/video/frame_ledger.hpp"
#include "geoloc/io/video/rtp_clock.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::io {

/// What the packets and reports of a stream tell about its frames. They arrive in different threads, so it is
/// thread-safe.
class StreamTiming {
 public:
  /// `latency` is from exposure to arrival, for frames whose capture time the stream does not tell.
  explicit StreamTiming(Duration latency) : latency_(latency), clock_(latency) {}

  /// Returns the number of packets lost before this one.
  std::uint64_t observe(const RtpPacket& packet, HostTime received_at);
  void observe(const SenderReport& report);

  /// A frame without its picture. Its RTP timestamp may have been lost in the decoder.
  VideoFrame stamp(std::optional<std::uint32_t> rtp_timestamp, HostTime decoded_at);

 private:
  std::mutex mutex_;
  const Duration latency_;
  FrameLedger ledger_;
  RtpClock clock_;
};

}  // namespace geoloc::io
