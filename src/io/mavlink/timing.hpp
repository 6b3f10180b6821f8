// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

inline constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};

/// Whether something last done at `last` is due again; if it was never done, it is due at once.
inline bool is_due(const std::optional<HostTime>& last, Duration period, HostTime now) {
  return !last || now < *last || now - *last >= period;
}

}  // namespace geoloc::io
