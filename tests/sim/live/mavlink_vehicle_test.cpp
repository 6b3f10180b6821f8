// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/mavlink_vehicle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

constexpr std::uint32_t kGlobalPositionInt = 33, kHomePosition = 242;
constexpr std::uint8_t kAccepted = 0, kDenied = 2, kUnsupported = 3;
constexpr io::MavAddress kCompanion{1, 191};
constexpr HostTime kStart{std::chrono::seconds{1'800'000'000}};
constexpr Duration kStep = std::chrono::milliseconds{5};

VehicleTime at(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

/// The vehicle of one flight, driven by the test's clock, and a peer that decodes with geoloc's own receiver
/// code.
class Vehicle : public ::testing::Test {
 protected:
  struct Received {
    HostTime at;
    std::uint32_t message_id;
    std::uint8_t sequence;
    io::Message message;
    Payload payload{};
  };

  Vehicle() : Vehicle(1.0) {}
  explicit Vehicle(double speed)
      : flight_(load("stock_path1")),
        clock_({at(100.0), at(160.0)}, speed),
        vehicle_(flight_, kStart - at(100.0).time_since_epoch()) {}

  void run(double for_s) {
    const HostTime end = now_ + from_seconds(for_s);
    for (; now_ < end; now_ += kStep) {
      for (const Datagram& datagram : vehicle_.take_due(now_, clock_)) receive(datagram);
    }
  }

  void say(const io::OutgoingFrame& frame) { vehicle_.receive(frame.bytes.data(), frame.size, now_, clock_); }

  void ask_for(std::uint32_t message_id, double rate_hz) {
    say(writer_.set_message_interval(kCompanion, MavlinkVehicle::kAddress, message_id, rate_hz));
  }

  std::vector<Received> of_type(std::uint32_t message_id) const {
    std::vector<Received> found;
    for (const Received& received : received_) {
      if (received.message_id == message_id) found.push_back(received);
    }
    return found;
  }

  template <typename Value>
  std::vector<Value> all() const {
    std::vector<Value> found;
    for (const Received& received : received_) {
      if (const auto* value = std::get_if<Value>(&received.message)) found.push_back(*value);
    }
    return found;
  }

  Flight flight_;
  FlightClock clock_;
  MavlinkVehicle vehicle_;
  io::CommandWriter writer_;
  HostTime now_ = kStart;
  std::vector<Received> received_;

 private:
  void receive(const Datagram& datagram) {
    ASSERT_EQ(parser_.append(datagram.data(), datagram.size()), datagram.size());
    const auto frame = parser_.next();
    ASSERT_TRUE(frame);  // the checksum was right
    ASSERT_EQ(frame->sender, MavlinkVehicle::kAddress);
    Received received{now_, frame->message_id, frame->sequence, io::decode(*frame), {}};
    std::copy_n(frame->payload, frame->payload_size, received.payload.begin());
    received_.push_back(received);
  }

  io::FrameParser parser_;
};

class FastVehicle : public Vehicle {
 protected:
  FastVehicle() : Vehicle(4.0) {}
};

TEST_F(Vehicle, SaysNothingButHeartbeatsUnasked) {
  clock_.release(now_);
  run(10.0);
  EXPECT_EQ(received_.size(), 10U);
  for (const io::Heartbeat& heartbeat : all<io::Heartbeat>()) EXPECT_TRUE(heartbeat.is_from_ardupilot());
  EXPECT_EQ(all<io::Heartbeat>().size(), 10U);
}

TEST_F(Vehicle, SendsWhatIsAskedForAtTheRateAskedForButNotFasterThanRecorded) {
  clock_.release(now_);
  ask_for(kAttitudeId, 4.0);
  ask_for(kGlobalPositionInt, 50.0);
  run(20.0);
  EXPECT_NEAR(static_cast<double>(of_type(kAttitudeId).size()), 80.0, 1.0);
  EXPECT_NEAR(static_cast<double>(of_type(kGlobalPositionInt).size()), 200.0, 2.0);
  const auto answers = all<io::CommandAck>();
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].result, kAccepted);
  EXPECT_EQ(answers[0].command, 511);
  EXPECT_EQ(answers[0].target, kCompanion);
}

TEST_F(Vehicle, NumbersItsMessagesWithoutGaps) {
  ask_for(kAttitudeId, 10.0);
  run(60.0);
  ASSERT_GT(received_.size(), 256U);
  for (std::size_t i = 1; i < received_.size(); ++i) {
    ASSERT_EQ(received_[i].sequence, static_cast<std::uint8_t>(received_[i - 1].sequence + 1));
  }
}

TEST_F(Vehicle, TellsTheFlightAsItTrulyWas) {
  clock_.release(now_);
  ask_for(kAttitudeId, 10.0);
  ask_for(kGlobalPositionInt, 10.0);
  run(30.0);
  const auto attitudes = all<io::AttitudeMessage>();
  ASSERT_GT(attitudes.size(), 290U);
  for (const io::AttitudeMessage& attitude : attitudes) {  // the clock reads what the recorded one read
    const auto truth = flight_.truth.pose(attitude.sample.time);
    ASSERT_TRUE(truth);
    const auto reported = enu_from_ned() * ned_from_body(attitude.sample.angles);
    EXPECT_LT(reported.angularDistance(truth->rotation), 1.5 * kRadPerDeg);
  }
  for (const PositionSample& position : all<PositionSample>()) {
    const auto truth = flight_.truth.pose(position.time);
    const auto reported_in_enu = flight_.truth.frame().to_local(position.position).position_in_enu;
    EXPECT_LT((reported_in_enu - truth->translation.head<2>()).norm(), 0.5);
    EXPECT_NEAR(position.height_above_home_m, truth->translation.z(), 0.5);
  }
}

TEST_F(FastVehicle, FliesTheSamePathInAQuarterOfTheTime) {
  clock_.release(now_);
  ask_for(kGlobalPositionInt, 10.0);
  run(14.0);
  const auto positions = all<PositionSample>();
  EXPECT_NEAR(static_cast<double>(positions.size()), 14.0 * 40.0, 8.0);
  for (const PositionSample& position : positions) {
    const double flown_s = 4.0 * seconds(position.time - at(100.0));
    const auto truth = flight_.truth.pose(at(100.0 + flown_s));
    ASSERT_TRUE(truth);
    const auto reported_in_enu = flight_.truth.frame().to_local(position.position).position_in_enu;
    EXPECT_LT((reported_in_enu - truth->translation.head<2>()).norm(), 0.5);
  }
}

TEST_F(FastVehicle, SaysThatItFliesFourTimesAsFast) {
  clock_.release(now_);
  ask_for(kGlobalPositionInt, 10.0);
  run(14.0);
  double fastest_m_s = 0.0;
  for (const Received& received : of_type(kGlobalPositionInt)) {
    const auto velocity = [&](std::size_t offset) {  // vx and vy, cm/s, at bytes 20 and 22
      return 0.01 * static_cast<std::int16_t>(received.payload[offset] | received.payload[offset + 1] << 8U);
    };
    fastest_m_s = std::max(fastest_m_s, std::hypot(velocity(20), velocity(22)));
  }
  EXPECT_NEAR(fastest_m_s, 20.0, 2.5);  // the flights are flown at 5 m/s
}

TEST_F(Vehicle, StandsStillWithARunningClockUntilReleasedAndAfterTheFlight) {
  ask_for(kGlobalPositionInt, 10.0);
  run(20.0);
  const auto waiting = all<PositionSample>();
  ASSERT_NEAR(static_cast<double>(waiting.size()), 200.0, 2.0);
  EXPECT_EQ(waiting.front().position.latitude_deg, waiting.back().position.latitude_deg);
  EXPECT_NEAR(seconds(waiting.back().time - waiting.front().time), 19.9, 0.11);
  clock_.release(now_);
  received_.clear();
  run(61.0);
  const auto flown = all<PositionSample>();
  EXPECT_NE(flown.front().position.latitude_deg, flown.back().position.latitude_deg);
  for (std::size_t i = 1; i < flown.size(); ++i) ASSERT_GE(flown[i].time, flown[i - 1].time);
  received_.clear();
  run(5.0);
  const auto after = all<PositionSample>();
  ASSERT_NEAR(static_cast<double>(after.size()), 50.0, 2.0);
  EXPECT_EQ(after.front().position.latitude_deg, after.back().position.latitude_deg);
}

TEST_F(Vehicle, AnswersTimesyncWithItsBootClock) {
  run(0.5);
  say(writer_.timesync_request(kCompanion, 123'456'789'012'345));
  const Duration asked_at = vehicle_.boot_clock(now_);
  run(0.01);
  const auto answers = all<io::Timesync>();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].requester_ns, 123'456'789'012'345);
  EXPECT_EQ(answers[0].vehicle_ns, asked_at.count());
}

TEST_F(Vehicle, RefusesWhatItDoesNotKnow) {
  ask_for(141, 10.0);  // ALTITUDE, which ArduPilot does not have
  ask_for(kAttitudeId, 1e9);
  ask_for(kAttitudeId, 1e-9);
  run(0.01);
  for (const io::CommandAck& answer : all<io::CommandAck>()) EXPECT_NE(answer.result, kUnsupported);
  EXPECT_EQ(all<io::CommandAck>().at(0).result, kDenied);
  EXPECT_EQ(all<io::CommandAck>().at(2).result, kDenied);
}

/// COMMAND_LONG in MAVLink 1, assembled by hand from the definition of the message, because geoloc itself
/// never sends such commands.
Datagram command_long(std::uint16_t command, float parameter1, std::uint8_t target_system) {
  constexpr std::size_t kHeader = 6, kPayload = 33, kChecksum = 2;
  constexpr std::uint8_t kChecksumSeed = 152;
  Datagram frame(kHeader + kPayload + kChecksum);
  const std::uint8_t header[kHeader] = {0xFE, kPayload, 0, 255, 190, 76};
  std::copy_n(header, kHeader, frame.begin());
  std::memcpy(&frame[kHeader], &parameter1, sizeof parameter1);
  std::memcpy(&frame[kHeader + 28], &command, sizeof command);
  frame[kHeader + 30] = target_system;
  frame[kHeader + 31] = 1;
  std::uint16_t crc = 0xFFFF;
  const auto add = [&crc](std::uint8_t byte) {
    crc = static_cast<std::uint16_t>(crc ^ byte);
    for (int bit = 0; bit < 8; ++bit)
      crc = static_cast<std::uint16_t>((crc >> 1) ^ ((crc & 1) != 0 ? 0x8408 : 0));
  };
  for (std::size_t i = 1; i < kHeader + kPayload; ++i) add(frame[i]);
  add(kChecksumSeed);
  frame[kHeader + kPayload] = static_cast<std::uint8_t>(crc & 0xFF);
  frame[kHeader + kPayload + 1] = static_cast<std::uint8_t>(crc >> 8);
  return frame;
}

TEST_F(Vehicle, SendsASingleMessageOnRequestAndSaysUnsupportedToTheRest) {
  const auto say_bytes = [&](const Datagram& bytes) {
    vehicle_.receive(bytes.data(), bytes.size(), now_, clock_);
  };
  say_bytes(command_long(512, kHomePosition, 1));
  say_bytes(command_long(512, 148, 1));   // AUTOPILOT_VERSION: the flights hold none
  say_bytes(command_long(400, 1.0F, 1));  // arm
  say_bytes(command_long(400, 1.0F, 2));  // for another vehicle
  run(0.01);
  EXPECT_EQ(of_type(kHomePosition).size(), 1U);
  const auto answers = all<io::CommandAck>();
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].result, kAccepted);
  EXPECT_EQ(answers[1].result, kDenied);
  EXPECT_EQ(answers[2].result, kUnsupported);
}

TEST_F(Vehicle, UnderstandsDataStreams) {
  constexpr std::uint8_t kExtra1 = 10, kPosition = 6;
  say(writer_.request_data_stream(kCompanion, MavlinkVehicle::kAddress, kExtra1, 5.0));
  say(writer_.request_data_stream(kCompanion, MavlinkVehicle::kAddress, kPosition, 2.0));
  clock_.release(now_);
  run(10.0);
  EXPECT_NEAR(static_cast<double>(of_type(kAttitudeId).size()), 50.0, 1.0);
  EXPECT_NEAR(static_cast<double>(of_type(kGlobalPositionInt).size()), 20.0, 1.0);
}

TEST_F(Vehicle, RebootStartsTheClockAnewAndForgetsWhatWasAskedFor) {
  clock_.release(now_);
  ask_for(kAttitudeId, 10.0);
  run(5.0);
  vehicle_.reboot(now_);
  received_.clear();
  run(1.0);
  EXPECT_TRUE(received_.empty());
  run(5.0);
  EXPECT_EQ(received_.size(), all<io::Heartbeat>().size());
  EXPECT_EQ(received_.at(0).sequence, 0);
  ask_for(kAttitudeId, 10.0);
  run(1.0);
  ASSERT_FALSE(all<io::AttitudeMessage>().empty());
  EXPECT_NEAR(seconds(all<io::AttitudeMessage>().front().sample.time.time_since_epoch()), 6.0, 0.2);
}

TEST_F(Vehicle, SurvivesJunk) {
  std::mt19937 engine(1);
  for (int i = 0; i < 2000; ++i) {
    Datagram junk(engine() % 300);
    for (std::uint8_t& byte : junk) byte = static_cast<std::uint8_t>(engine() % 8 == 0 ? 0xFD : engine());
    vehicle_.receive(junk.data(), junk.size(), now_, clock_);
  }
  ask_for(kAttitudeId, 10.0);  // the parser may wait for the rest of what junk announced
  ask_for(kAttitudeId, 10.0);
  for (int i = 0; i < 10; ++i) ask_for(kAttitudeId, 10.0);
  run(1.0);
  EXPECT_FALSE(of_type(kAttitudeId).empty());
}

}  // namespace
}  // namespace geoloc::sim
