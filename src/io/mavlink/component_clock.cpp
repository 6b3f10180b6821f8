// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/component_clock.hpp"

#include "mav_numbers.hpp"

namespace geoloc::io {

std::optional<VehicleTime> ComponentClock::to_vehicle(std::uint8_t component,
                                                      std::optional<VehicleTime> stamp, HostTime received_at,
                                                      const VehicleClock& clock) {
  if (!stamp) return clock.map.to_vehicle(received_at);
  if (component != kAutopilotComponent) return by_arrival(*stamp, received_at, clock.map);
  if (!clock.boot.is_near_newest(*stamp) || clock.map.is_early(*stamp, received_at)) return std::nullopt;
  return stamp;
}

std::optional<VehicleTime> ComponentClock::by_arrival(VehicleTime stamp, HostTime received_at,
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
