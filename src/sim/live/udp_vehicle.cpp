// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/udp_vehicle.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

#include "geoloc/io/address_lookup.hpp"
#include "geoloc/sim/flight/random_stream.hpp"

namespace geoloc::sim {
namespace {

/// Long enough to cost nothing, short enough that no message is late for it.
constexpr std::chrono::milliseconds kStep{2};

io::UdpPeer resolve(const io::UdpEndpoint& endpoint) {
  if (endpoint.port == 0) throw std::invalid_argument("--udp: port 0 cannot be sent to");
  const auto [found, fault] = io::look_up(endpoint.host, std::to_string(endpoint.port), SOCK_DGRAM);
  if (!found) throw std::runtime_error("--udp: " + endpoint.host + " is not a known host: " + fault);
  io::UdpPeer peer;
  std::memcpy(&peer.address, found->ai_addr, found->ai_addrlen);
  peer.address_size = found->ai_addrlen;
  return peer;
}

/// Any free port, of the peer's address family.
io::UdpEndpoint any_port(const io::UdpPeer& peer) {
  return {peer.address.ss_family == AF_INET6 ? "::" : "0.0.0.0", 0};
}

}  // namespace

UdpVehicle::UdpVehicle(const Flight& flight, const UdpVehicleSettings& settings,
                       const FlightClock& flight_clock, const io::HostClock& host_clock)
    : flight_clock_(flight_clock),
      host_clock_(host_clock),
      socket_(any_port(resolve(settings.peer))),
      // As if it had booted when the recorded one did: at speed 1, without waiting, its clock reads what was
      // recorded.
      vehicle_(flight, host_clock.now() - flight_clock.span().begin.time_since_epoch(), settings.manners),
      to_peer_(settings.faults, stream_seed(settings.seed, RandomStream::kLink)),
      from_peer_(settings.faults, stream_seed(settings.seed + 1, RandomStream::kLink)) {
  socket_.answer(resolve(settings.peer));
  if (settings.reboot_at_s) reboot_after_ = from_seconds(*settings.reboot_at_s);
}

void UdpVehicle::run(const std::atomic<bool>& stop) {
  while (!stop) {
    if (const auto datagram = socket_.receive(kStep)) {
      from_peer_.send({datagram->data, datagram->data + datagram->size}, host_clock_.now());
    }
    step(host_clock_.now());
  }
}

void UdpVehicle::step(HostTime now) {
  const bool is_time_to_reboot = reboot_after_ && flight_clock_.is_released() &&
                                 now - flight_clock_.host_time(flight_clock_.span().begin) >= *reboot_after_;
  if (is_time_to_reboot) {
    vehicle_.reboot(now);
    reboot_after_.reset();
  }
  while (const auto datagram = from_peer_.receive(now)) {
    vehicle_.receive(datagram->data(), datagram->size(), now, flight_clock_);
  }
  for (Datagram& datagram : vehicle_.take_due(now, flight_clock_)) to_peer_.send(std::move(datagram), now);
  while (const auto datagram = to_peer_.receive(now)) socket_.send(datagram->data(), datagram->size());
  has_listener_ = vehicle_.has_listener();
  messages_sent_ = vehicle_.messages_sent();
}

}  // namespace geoloc::sim
