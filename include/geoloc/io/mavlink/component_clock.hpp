// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

/// When messages of a vehicle's component were made, on the vehicle's clock. The autopilot has that clock;
/// any other component has a boot clock of its own, which is known by the arrival of its messages.
class ComponentClock {
 public:
  /// `stamp`: on the component's clock; nullopt where the message has none, so that its arrival counts.
  /// nullopt where the time cannot be.
  std::optional<VehicleTime> to_vehicle(std::uint8_t component, std::optional<VehicleTime> stamp,
                                        HostTime received_at, const VehicleClock& clock);

 private:
  std::optional<VehicleTime> by_arrival(VehicleTime stamp, HostTime received_at, const VehicleClockMap& map);

  ArrivalOffset offset_;  // against the host's clock
  BootClockMonitor boot_clock_;
};

}  // namespace geoloc::io
