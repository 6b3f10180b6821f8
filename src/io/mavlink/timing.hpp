// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

inline constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};

/// An autopilot is given so long to send the state it is asked for, where another one waits.
inline constexpr Duration kAutopilotsTurn = std::chrono::seconds{5};

/// Recordings keep whole microseconds. In an answer to a TIMESYNC request, the digits below those show that
/// the request was ours.
inline constexpr std::int64_t kNanosecondsPerStamp = 1000;

/// Whether something last done at `last` is due again; if it was never done, it is due at once.
inline bool is_due(const std::optional<HostTime>& last, Duration period, HostTime now) {
  return !last || now < *last || now - *last >= period;
}

}  // namespace geoloc::io
