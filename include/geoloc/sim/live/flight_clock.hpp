// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <limits>

#include "geoloc/sim/flight/trajectory.hpp"

namespace geoloc::sim {

/// Ties real time to a recorded flight: waits at the beginning of a span until it is released, then flies
/// `speed` times as fast as was flown, and stays at the end. One thread may release while others read.
class FlightClock {
 public:
  /// speed must be > 0 and finite, the span must not be empty.
  FlightClock(TimeSpan span, double speed) : span_(span), speed_(speed) {}

  /// Starts the flight; later calls change nothing.
  void release(HostTime now) {
    Duration::rep not_yet = kNever;
    released_at_ns_.compare_exchange_strong(not_yet, now.time_since_epoch().count());
  }

  /// The time of the flight, on the clock of its log, that is flown at a real time.
  VehicleTime flight_time(HostTime now) const {
    if (!is_released() || now < released_at()) return span_.begin;
    const Duration flown = from_seconds(seconds(now - released_at()) * speed_);
    return flown < span_.end - span_.begin ? span_.begin + flown : span_.end;
  }

  /// When a time of the flight is flown; defined once is_released(), also a little before the span.
  HostTime host_time(VehicleTime flight_time) const {
    return released_at() + from_seconds(seconds(flight_time - span_.begin) / speed_);
  }

  bool is_released() const { return released_at_ns_ != kNever; }
  bool is_over(HostTime now) const { return flight_time(now) == span_.end; }
  bool is_flying(HostTime now) const { return is_released() && now >= released_at() && !is_over(now); }

  TimeSpan span() const { return span_; }
  double speed() const { return speed_; }

 private:
  static constexpr Duration::rep kNever = std::numeric_limits<Duration::rep>::max();

  HostTime released_at() const { return HostTime{Duration{released_at_ns_}}; }

  TimeSpan span_;
  double speed_;
  std::atomic<Duration::rep> released_at_ns_{kNever};
};

}  // namespace geoloc::sim
