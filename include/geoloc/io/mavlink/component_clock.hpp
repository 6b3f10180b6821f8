// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/io/mavlink/clock_mapping.hpp"
#include "geoloc/state/boot_clock_monitor.hpp"

namespace geoloc::io {

/// The vehicle's clock, which its gimbal and its camera teach nothing: what is made of the vehicle's messages
/// must not depend on whether there is one.
struct VehicleClock {
  const VehicleClockMap& map;
  const BootClockMonitor& boot;
};

/// The boot clock of a component beside the autopilot, which is known by the arrival of its messages.
class ComponentClock {
 public:
  /// On the vehicle's clock; nullopt where it cannot be told.
  std::optional<VehicleTime> to_vehicle(VehicleTime stamp, HostTime received_at, const VehicleClockMap& map);

 private:
  ArrivalOffset offset_;  // against the host's clock
  BootClockMonitor boot_clock_;
};

}  // namespace geoloc::io
