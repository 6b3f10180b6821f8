// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/video_vehicle.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::apps {

/// Tells how uncertain the stamps of a stream's frames are. What stays the same over a flight does not count,
/// since the estimator learns it; but a frame that is stamped by its arrival is late by the stream's whole
/// delay against those that follow once the sender's clock is known, and nobody knows that delay yet.
class StampSigma {
 public:
  /// 1-sigma of the frame's time [s]. Frames in the order of their arrival.
  double observe(io::TimeQuality quality, HostTime received_at) {
    const bool is_new = !newest_ || received_at - *newest_ > kPause || received_at < *newest_;
    const bool is_worse = is_settled_ && is_by_arrival(quality) && !is_by_arrival(quality_);
    if (is_new || is_worse) began_at_ = received_at;
    newest_ = received_at;
    quality_ = quality;
    is_settled_ = !is_by_arrival(quality) || received_at - began_at_ > kReportsComeWithin;
    if (!is_settled_) return kUnknownDelay_s;
    if (quality == io::TimeQuality::kUnconfirmed) return kUnconfirmed_s;
    if (quality == io::TimeQuality::kTelemetry) return kToldTimeSigma_s;
    return quality == io::TimeQuality::kArrival ? kJitterOfArrival_s : kRecovered_s;
  }

 private:
  static constexpr double kRecovered_s = 0.01, kJitterOfArrival_s = 0.03, kUnconfirmed_s = 0.05;
  static constexpr double kUnknownDelay_s = 0.3;
  /// A stream that is stamped by arrival for longer will be to its end: its delay is a constant.
  static constexpr Duration kReportsComeWithin = std::chrono::seconds{12};
  /// Longer than any pause of a stream that was not closed and opened again.
  static constexpr Duration kPause = std::chrono::milliseconds{1500};

  static bool is_by_arrival(io::TimeQuality quality) {
    return quality == io::TimeQuality::kArrival || quality == io::TimeQuality::kForeignClock;
  }

  std::optional<HostTime> newest_;
  HostTime began_at_{};
  io::TimeQuality quality_ = io::TimeQuality::kArrival;
  bool is_settled_ = false;
};

}  // namespace geoloc::apps
