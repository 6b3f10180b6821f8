// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

inline constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};

/// Whether what was last done then is to be done again now; at once where it never was.
inline bool is_due(const std::optional<HostTime>& last, Duration period, HostTime now) {
  return !last || now < *last || now - *last >= period;
}

}  // namespace geoloc::io
