// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/component_clock.hpp"

namespace geoloc::io {

std::optional<VehicleTime> ComponentClock::to_vehicle(VehicleTime stamp, HostTime received_at,
                                                      const VehicleClockMap& map) {
  switch (boot_clock_.observe(stamp)) {
    case BootClockMonitor::Verdict::kSuspect:
      return std::nullopt;
    case BootClockMonitor::Verdict::kRebooted:
      offset_.clear();
      break;
    case BootClockMonitor::Verdict::kAdvanced:
      break;
  }
  offset_.add(stamp, received_at);
  const auto offset = offset_.offset();
  if (!offset) return std::nullopt;
  return map.to_vehicle(HostTime{stamp.time_since_epoch() - *offset});
}

}  // namespace geoloc::io
