// SPDX-License-Identifier: Apache-2.0
// A vehicle that behaves as PX4 does, heard by geoloc's own receiver.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "geoloc/sim/live/mavlink_vehicle.hpp"
#include "geoloc/sim/live/px4_flight.hpp"
#include "geoloc/sim/live/state_jumps.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

constexpr std::uint32_t kAttitude = 30, kPosition = 33, kGpsRawInt = 24, kTimesync = 111, kHomePosition = 242,
                        kEkfStatus = 193, kEstimatorStatus = 230, kStatusText = 253;
constexpr HostTime kStart{std::chrono::seconds{1'800'000'000}};
constexpr Duration kStep = std::chrono::milliseconds{5};

VehicleTime at(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

struct Positions final : io::TelemetrySink {
  void on_attitude(const AttitudeSample&) override {}
  void on_position(const PositionSample& sample) override { received.push_back(sample); }
  void on_reboot() override {}
  void on_clock_step(Duration) override {}
  void on_frame(HostTime, const std::uint8_t* data, std::size_t size) override {
    const auto frame = view_frame(data, size);
    ++count[frame->message_id];
    is_v2.push_back(data[0] == 0xFD);
  }

  std::vector<PositionSample> received;
  std::map<std::uint32_t, int> count;
  std::vector<bool> is_v2;
};

/// The recorded flight has no more than these.
io::MavlinkConfig at_the_told_rates() {
  io::MavlinkConfig config;
  config.fast_rate_hz = 0.0;
  return config;
}

/// The vehicle and geoloc's link, in steps of the test's clock. The link may be silent.
class Px4Vehicle : public ::testing::Test {
 protected:
  explicit Px4Vehicle(AutopilotManners manners = px4_onboard_manners())
      : vehicle_(flight_, kStart - at(100.0).time_since_epoch(), std::move(manners)) {}

  void run(double for_s, bool is_listener_silent = false) {
    const HostTime end = now_ + from_seconds(for_s);
    for (; now_ < end; now_ += kStep) {
      for (const Datagram& datagram : vehicle_.take_due(now_, clock_))
        link_.consume(now_, datagram.data(), datagram.size(), sink_);
      if (is_listener_silent) continue;
      link_.poll(now_, [&](const std::uint8_t* data, std::size_t size) {
        vehicle_.receive(data, size, now_, clock_);
      });
    }
  }

  Flight flight_ = as_px4(load("stock_path1"));
  FlightClock clock_{{at(100.0), at(160.0)}, 1.0};
  MavlinkVehicle vehicle_;
  io::VehicleLink link_{at_the_told_rates()};
  Positions sink_;
  HostTime now_ = kStart;
};

class Px4VehicleForGround : public Px4Vehicle {
 protected:
  Px4VehicleForGround() : Px4Vehicle(px4_ground_manners()) {}
};

TEST_F(Px4Vehicle, SendsItsOnboardMessagesUnaskedInMavlink1) {
  clock_.release(now_);
  run(10.0, true);
  EXPECT_EQ(std::set<bool>(sink_.is_v2.begin(), sink_.is_v2.end()), std::set<bool>{false});
  EXPECT_NEAR(sink_.count[kAttitude], 100, 2) << "not faster than recorded";
  EXPECT_NEAR(sink_.count[kPosition], 100, 2);
  EXPECT_NEAR(sink_.count[kGpsRawInt], 50, 2);
  EXPECT_NEAR(sink_.count[kEstimatorStatus], 10, 1);
  EXPECT_NEAR(sink_.count[kHomePosition], 5, 1);
  EXPECT_NEAR(sink_.count[kTimesync], 100, 2);
  EXPECT_EQ(sink_.count[kEkfStatus], 0);
  EXPECT_FALSE(vehicle_.has_listener());
}

TEST_F(Px4Vehicle, SpeaksMavlink2OnceItHearsGeoloc) {
  clock_.release(now_);
  run(10.0);
  EXPECT_TRUE(vehicle_.has_listener());
  EXPECT_TRUE(link_.status(now_).is_v2);
  EXPECT_EQ(sink_.received.back().sigma_horizontal_m, 0.3) << "h_acc, which version 1 does not have";
  EXPECT_EQ(link_.status(now_).clock_source, io::VehicleClockMap::Source::kRoundTrip);
  EXPECT_EQ(link_.status(now_).requests.requests, 0U) << "it sends enough by itself";
}

TEST_F(Px4VehicleForGround, IsAskedForWhatItSendsTooSeldom) {
  clock_.release(now_);
  run(10.0);
  EXPECT_NEAR(link_.status(now_).position_rate_hz, 10.0, 0.7);
  EXPECT_EQ(link_.status(now_).requests.denials, 0U);
  sink_.count.clear();
  run(10.0);
  EXPECT_NEAR(sink_.count[kGpsRawInt], 20, 2);
  EXPECT_NEAR(sink_.count[kEstimatorStatus], 10, 1);
}

TEST_F(Px4VehicleForGround, FailsWhatItDoesNotHaveAndLeavesDataStreamsAlone) {
  io::CommandWriter writer;
  const auto say = [&](const io::OutgoingFrame& frame) {
    vehicle_.receive(frame.bytes.data(), frame.size, now_, clock_);
  };
  run(1.0, true);
  sink_.count.clear();
  say(writer.set_message_interval({1, 191}, MavlinkVehicle::kAddress, kEkfStatus, 2.0));
  std::vector<int> results;
  for (const Datagram& datagram : vehicle_.take_due(now_, clock_)) {
    io::FrameParser parser;
    parser.append(datagram.data(), datagram.size());
    const io::Message message = io::decode(*parser.next());
    if (const auto* const ack = std::get_if<io::CommandAck>(&message)) results.push_back(ack->result);
  }
  EXPECT_EQ(results, std::vector<int>{4}) << "MAV_RESULT_FAILED";
  say(writer.request_data_stream({1, 191}, MavlinkVehicle::kAddress, 6, 20.0));
  clock_.release(now_);
  run(4.0, true);
  EXPECT_NEAR(sink_.count[kPosition], 20, 1) << "as before";
}

TEST_F(Px4VehicleForGround, GoesBackToItsOwnRateWhereThatIsAskedFor) {
  io::CommandWriter writer;
  const auto ask = [&](double interval_rate_hz) {
    const auto frame =
        writer.set_message_interval({1, 191}, MavlinkVehicle::kAddress, kPosition, interval_rate_hz);
    vehicle_.receive(frame.bytes.data(), frame.size, now_, clock_);
  };
  clock_.release(now_);
  run(1.0, true);
  ask(2.0);
  run(1.0, true);
  sink_.count.clear();
  run(4.0, true);
  EXPECT_NEAR(sink_.count[kPosition], 8, 1);
  ask(1e9);  // an interval of 0
  run(1.0, true);
  sink_.count.clear();
  run(4.0, true);
  EXPECT_NEAR(sink_.count[kPosition], 20, 1);
}

TEST_F(Px4Vehicle, BeginsAnewAfterAReboot) {
  clock_.release(now_);
  run(5.0);
  vehicle_.reboot(now_);
  sink_.is_v2.clear();
  run(4.0, true);
  ASSERT_FALSE(sink_.is_v2.empty());
  EXPECT_FALSE(sink_.is_v2.back());
  EXPECT_GT(sink_.count[kAttitude], 60);
}

TEST(Px4Flight, TellsWhatPx4TellsOfTheSameFlight) {
  const Flight flight = as_px4(load("gnss_path1"));
  std::map<std::uint32_t, int> count;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    io::FrameParser parser;
    parser.append(record.frame, record.size);
    const auto frame = parser.next();
    ASSERT_TRUE(frame);
    ++count[frame->message_id];
    const io::Message message = io::decode(*frame);
    if (const auto* const heartbeat = std::get_if<io::Heartbeat>(&message)) {
      EXPECT_TRUE(heartbeat->is_from_px4());
    }
    if (const auto* const status = std::get_if<io::EstimatorStatus>(&message);
        status && count[kGpsRawInt] > 0) {
      EXPECT_TRUE(status->has_absolute_position());
      EXPECT_NEAR(status->sigma_horizontal_m.value_or(0.0), 0.8, 1e-6);
      EXPECT_FALSE(status->has_gnss_glitch);
    }
  }
  EXPECT_GT(count[kEstimatorStatus], 400);
  EXPECT_EQ(count[kEkfStatus], 0);
  EXPECT_EQ(count[kStatusText], 0);
}

}  // namespace
}  // namespace geoloc::sim
