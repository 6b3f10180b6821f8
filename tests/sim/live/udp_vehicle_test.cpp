// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/udp_vehicle.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

struct Counter final : io::TelemetrySink {
  void on_attitude(const AttitudeSample&) override { ++attitudes; }
  void on_position(const PositionSample&) override { ++positions; }
  void on_reboot() override {}
  void on_clock_step(Duration) override {}
  void on_frame(HostTime, const std::uint8_t*, std::size_t) override {}

  int attitudes = 0;
  int positions = 0;
};

TEST(UdpVehicle, GivesGeolocsOwnReceiverWhatItAsksForOverARealSocket) {
  const Flight flight = load("stock_path6");
  const FlightClock flight_clock(flight.truth.survey(), 1.0);
  const io::HostClock host_clock;
  io::UdpSocket socket({"127.0.0.1", 0});
  UdpVehicleSettings settings;
  settings.peer = {"127.0.0.1", socket.local_port()};
  UdpVehicle vehicle(flight, settings, flight_clock, host_clock);
  std::atomic<bool> stop{false};
  std::thread thread([&] { vehicle.run(stop); });

  io::VehicleLink link{io::MavlinkConfig{}};
  Counter counter;
  while (counter.attitudes < 5 || counter.positions < 5 ||
         link.clock().source() != io::VehicleClockMap::Source::kRoundTrip) {
    if (const auto datagram = socket.receive(std::chrono::milliseconds{20})) {
      if (link.consume(host_clock.now(), datagram->data, datagram->size, counter))
        socket.answer(datagram->sender);
    }
    link.poll(host_clock.now(), [&](const std::uint8_t* data, std::size_t size) { socket.send(data, size); });
  }
  EXPECT_TRUE(vehicle.has_listener());
  stop = true;
  thread.join();
}

TEST(UdpVehicle, RefusesAPeerThatCannotBeReached) {
  const Flight flight = load("stock_path6");
  const FlightClock flight_clock(flight.truth.survey(), 1.0);
  const io::HostClock host_clock;
  UdpVehicleSettings settings;
  settings.peer = {"no such host", 14550};
  EXPECT_THROW(UdpVehicle(flight, settings, flight_clock, host_clock), std::runtime_error);
  settings.peer = {"127.0.0.1", 0};
  EXPECT_THROW(UdpVehicle(flight, settings, flight_clock, host_clock), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::sim
