// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>

namespace geoloc {

using Duration = std::chrono::nanoseconds;

/// Tags a time with the clock it was read on. A tag has no now(): time comes into the library with the data,
/// so a replay is deterministic, and a time of one clock cannot be passed where the other is meant.
template <typename Tag>
struct Clock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<Clock>;
  static constexpr bool is_steady = true;
};

/// The autopilot's clock: counts from its boot, starts again after a reboot.
using VehicleTime = Clock<struct VehicleClockTag>::time_point;

/// The clock of the computer geoloc runs on: nanoseconds since the UNIX epoch, read once at start-up and
/// carried on by the monotonic clock, so that it is UTC to look at and never steps. Stamps of recordings are
/// on this clock.
using HostTime = Clock<struct HostClockTag>::time_point;

/// Differences stay integer nanoseconds until here.
constexpr double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Nearest nanosecond. `value_s` must be finite and within +-292 years.
inline Duration from_seconds(double value_s) {
  return Duration{std::llround(value_s * 1e9)};
}

}  // namespace geoloc
