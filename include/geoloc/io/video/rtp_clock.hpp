// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::io {

/// The sender's wall clock, since the UNIX epoch if it is set at all. A tag, as in geometry/time.hpp.
using SenderTime = Clock<struct SenderClockTag>::time_point;

/// An RTCP sender report (RFC 3550, 6.4.1): the same instant on the stream's RTP clock and on the sender's
/// wall clock.
struct SenderReport {
  std::uint32_t rtp_timestamp = 0;
  std::uint32_t ticks_per_second = 90'000;
  SenderTime sent_at;
};

/// The 64-bit NTP time stamp of a sender report as time since the UNIX epoch.
SenderTime from_ntp(std::uint64_t ntp_time);

/// Maps RTP timestamps to capture times. A report is trusted when a second one confirms it, because the first
/// report of a starting server may be tens of milliseconds off. A trusted mapping stays until two newer
/// reports agree on another.
///
/// It cannot detect a sender that is late by less than kLargestDelay because its clock is slow or its reports
/// are shifted by the latency of its own encoder. That is a constant, which the estimator finds.
class RtpClock {
 public:
  struct Capture {
    HostTime captured_at;  ///< whole microseconds, never after received_at
    TimeQuality quality = TimeQuality::kArrival;
  };

  /// `latency` is from exposure to arrival, for streams that do not tell the capture time.
  explicit RtpClock(Duration latency) : latency_(latency) {}

  void observe(const SenderReport& report);

  /// Not const: the smallest delay seen tells whether the sender's clock is UTC.
  Capture capture_time(std::uint32_t rtp_timestamp, HostTime received_at);

  /// A sender's clock further behind than this is not UTC.
  static constexpr Duration kLargestDelay = std::chrono::seconds{3};
  /// Nor is one further ahead than this: its frames would come from the future.
  static constexpr Duration kLargestLead = std::chrono::milliseconds{5};
  /// Timestamps are mapped up to this far from a report; beyond, it is too old, or the timestamp is of
  /// another stream.
  static constexpr Duration kReportLifetime = std::chrono::minutes{2};

 private:
  /// Minimum over a sliding window, in two halves: senders' clocks drift, so an old minimum must not last.
  class SlidingMinimum {
   public:
    Duration observe(HostTime at, Duration value);
    void clear() { current_ = previous_ = Duration::max(); }

   private:
    static constexpr Duration kHalfWindow = std::chrono::seconds{15};
    HostTime half_started_at_;
    Duration current_ = Duration::max();
    Duration previous_ = Duration::max();
  };

  Duration latency_;
  std::optional<SenderReport> trusted_;
  std::optional<SenderReport> newest_;
  SlidingMinimum smallest_delay_;
};

}  // namespace geoloc::io
