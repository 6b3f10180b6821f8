// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/mavlink/udp_socket.hpp"
#include "geoloc/sim/live/link_faults.hpp"
#include "geoloc/sim/live/mavlink_vehicle.hpp"

namespace geoloc::sim {

struct UdpVehicleSettings {
  io::UdpEndpoint peer{"127.0.0.1",
                       14550};  ///< where the vehicle speaks to, from a port of the system's choice
  AutopilotManners manners = ardupilot_manners();
  LinkFaults faults;                  ///< in both directions
  std::uint64_t seed = 1;             ///< of the faults
  std::optional<double> reboot_at_s;  ///< [s] of real time into the flight
};

/// A MavlinkVehicle on a UDP socket. run() blocks its thread; the rest may be called from others.
class UdpVehicle {
 public:
  /// The flight and the clocks must outlive it. Throws std::invalid_argument for bad faults and for port 0,
  /// std::runtime_error where the peer's name is unknown or there is no socket.
  UdpVehicle(const Flight& flight, const UdpVehicleSettings& settings, const FlightClock& flight_clock,
             const io::HostClock& host_clock);

  /// Plays until `stop`.
  void run(const std::atomic<bool>& stop);

  bool has_listener() const { return has_listener_; }
  std::uint64_t messages_sent() const { return messages_sent_; }

 private:
  void step(HostTime now);

  const FlightClock& flight_clock_;
  const io::HostClock& host_clock_;
  io::UdpSocket socket_;
  MavlinkVehicle vehicle_;
  FaultyLink to_peer_;
  FaultyLink from_peer_;
  std::optional<Duration> reboot_after_;
  std::atomic<bool> has_listener_{false};
  std::atomic<std::uint64_t> messages_sent_{0};
};

}  // namespace geoloc::sim
