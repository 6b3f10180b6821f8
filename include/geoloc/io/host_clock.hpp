// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// Reads the host clock: UTC at construction, advanced by the monotonic clock. It gives whole microseconds,
/// because recordings store those and a replay must see the same times. Make one per program and pass it
/// along.
class HostClock {
 public:
  HostClock() : HostClock(std::chrono::system_clock::now(), std::chrono::steady_clock::now()) {}

  HostTime now() const { return at(std::chrono::steady_clock::now()); }

  HostTime at(std::chrono::steady_clock::time_point monotonic) const {
    return HostTime{
        std::chrono::floor<std::chrono::microseconds>(utc_at_start_ + (monotonic - monotonic_at_start_))};
  }

 private:
  HostClock(std::chrono::system_clock::time_point utc, std::chrono::steady_clock::time_point monotonic)
      : utc_at_start_(utc.time_since_epoch()), monotonic_at_start_(monotonic) {}

  Duration utc_at_start_;
  std::chrono::steady_clock::time_point monotonic_at_start_;
};

}  // namespace geoloc::io
