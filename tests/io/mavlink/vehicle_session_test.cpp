// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/fake_autopilot.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::FakeAutopilot;
using testing::Session;

constexpr std::uint32_t kHeartbeat = 0, kSystemTime = 2, kGpsRawInt = 24, kAttitude = 30, kPosition = 33,
                        kRequestDataStream = 66, kCommandLong = 76, kTimesync = 111, kEkfStatus = 193,
                        kEstimatorStatus = 230;

TEST(VehicleSession, SaysNothingUntilAVehicleIsHeard) {
  Session session;
  session.autopilot.character.is_mute = true;
  session.run(5s);
  int sent = 0;
  session.link.poll(session.now, [&](const std::uint8_t*, std::size_t) { ++sent; });
  EXPECT_EQ(sent, 0);
}

TEST(VehicleSession, IsAnOnboardComputerOfTheVehicle) {
  Session session;
  session.run(20s);
  const auto heartbeats = session.autopilot.heard_of(kHeartbeat);
  EXPECT_NEAR(static_cast<double>(heartbeats.size()), 20.0, 1.0);
  for (const auto& heartbeat : heartbeats) {
    EXPECT_EQ(heartbeat.sender, (MavAddress{1, 191}));
    EXPECT_EQ(heartbeat.vehicle_type, 18);
  }
}

TEST(VehicleSession, GetsTheRatesItAsksFor) {
  MavlinkConfig config = testing::with_steady_rates();
  config.attitude_rate_hz = 25.0;
  Session session(config);
  session.run(10s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 25.0, 1.0);
  EXPECT_NEAR(session.link.status(session.now).position_rate_hz, 10.0, 0.7);
  for (const std::uint32_t id : {kAttitude, kPosition, kGpsRawInt, kSystemTime, kEkfStatus}) {
    EXPECT_EQ(session.autopilot.requests_for(id).size(), 1U) << id;
  }
  EXPECT_EQ(session.autopilot.requests_for(kAttitude).at(0).wanted_rate_hz, 25.0);
  EXPECT_TRUE(session.autopilot.requests_for(kEstimatorStatus).empty());
  EXPECT_TRUE(session.autopilot.heard_of(kRequestDataStream).empty());
  EXPECT_EQ(session.link.status(session.now).fix_type, 3);
}

TEST(VehicleSession, AsksForMoreWhereTheLinkBearsIt) {
  Session session(MavlinkConfig{});
  session.run(4s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
  session.run(12s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 50.0, 1.0);
  EXPECT_NEAR(session.link.status(session.now).position_rate_hz, 50.0, 1.0);
  EXPECT_EQ(session.autopilot.requests_for(kAttitude).size(), 2U);
  EXPECT_EQ(session.autopilot.requests_for(kSystemTime).size(), 1U) << "what is not of the state stays";
}

TEST(VehicleSession, AsksForLessAgainWhereTheLinkDoesNotBearIt) {
  Session session(MavlinkConfig{});
  session.run(16s);
  session.delay = 8;  // in each direction of a link whose buffers have filled
  session.run(12s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
  EXPECT_NEAR(session.link.status(session.now).position_rate_hz, 10.0, 0.7);
  EXPECT_EQ(session.autopilot.requests_for(kAttitude).back().wanted_rate_hz, 10.0);
  session.run(20s);
  EXPECT_EQ(session.autopilot.requests_for(kAttitude).size(), 3U);
}

TEST(VehicleSession, AsksForMoreAgainAfterAReboot) {
  Session session(MavlinkConfig{});
  session.run(16s);
  session.autopilot.reboot(session.now - 10s);
  session.run(4s);
  EXPECT_GE(session.link.status(session.now).attitude_rate_hz, 9.3);
  session.run(16s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 50.0, 1.0);
}

TEST(VehicleSession, AsksOtherAutopilotsForTheirOwnEstimatorStatus) {
  Session session;
  session.autopilot.character.autopilot = testing::kPx4;
  session.run(5s);
  EXPECT_TRUE(session.autopilot.requests_for(kEkfStatus).empty());
  EXPECT_FALSE(session.autopilot.requests_for(kEstimatorStatus).empty());
}

TEST(VehicleSession, DoesNotAskForWhatComesAnyway) {
  Session session;
  session.run(10s);
  const auto asked = session.autopilot.heard_of(kCommandLong).size();
  session.run(60s);
  EXPECT_EQ(session.autopilot.heard_of(kCommandLong).size(), asked);
}

TEST(VehicleSession, AsksAgainWhenTheAnswerIsLost) {
  Session session;
  session.autopilot.character.answer.reset();
  session.autopilot.character.obeys_intervals = false;
  session.run(4s);
  EXPECT_GE(session.autopilot.heard_of(kCommandLong).size(), 3U);
  session.autopilot.character.answer = 0;
  session.autopilot.character.obeys_intervals = true;
  session.run(60s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
}

TEST(VehicleSession, HasOneRequestOpenAtATime) {
  Session session;
  session.autopilot.character.answer.reset();
  session.autopilot.character.obeys_intervals = false;
  session.run(20s);
  const auto requests = session.autopilot.heard_of(kCommandLong);
  for (std::size_t i = 1; i < requests.size(); ++i) EXPECT_GE(requests[i].at - requests[i - 1].at, 1s);
}

TEST(VehicleSession, TriesTheOldWayOnAutopilotsThatKnowNoOther) {
  Session session;
  session.autopilot.character.answer = 3;  // MAV_RESULT_UNSUPPORTED
  session.autopilot.character.obeys_intervals = false;
  session.autopilot.character.obeys_data_streams = true;
  session.run(10s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
  EXPECT_NEAR(session.link.status(session.now).position_rate_hz, 10.0, 0.7);
}

TEST(VehicleSession, TriesTheOldWayWhenNothingIsAnswered) {
  Session session;
  session.autopilot.character.answer.reset();
  session.autopilot.character.obeys_intervals = false;
  session.autopilot.character.obeys_data_streams = true;
  session.run(60s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
  EXPECT_NEAR(session.link.status(session.now).position_rate_hz, 10.0, 0.7);
}

TEST(VehicleSession, DoesNotInsistWhenDenied) {
  Session session;
  session.autopilot.character.answer = 2;  // MAV_RESULT_DENIED
  session.autopilot.character.obeys_intervals = false;
  session.run(300s);
  EXPECT_LE(session.autopilot.requests_for(kAttitude).size(), 15U);
  EXPECT_GE(session.autopilot.requests_for(kAttitude).size(), 5U);
  EXPECT_TRUE(session.autopilot.heard_of(kRequestDataStream).empty())
      << "the command is known: the old way is no help";
  EXPECT_GT(session.link.status(session.now).requests.denials, 0U);
}

TEST(VehicleSession, AsksAnewAfterAReboot) {
  Session session;
  session.run(10s);
  session.autopilot.heard.clear();
  session.autopilot.reboot(session.now - 10s);
  session.run(10s);
  EXPECT_EQ(session.autopilot.requests_for(kAttitude).size(), 1U);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
  EXPECT_EQ(session.sink.reboots_at.size(), 1U);
  EXPECT_EQ(session.link.status(session.now).telemetry.reboots, 1U);
}

TEST(VehicleSession, StopsAskingAVehicleThatIsGoneAndAsksAnewWhenItIsBack) {
  Session session;
  session.run(10s);
  session.autopilot.character.is_mute = true;
  session.run(60s);
  const auto requests = session.link.status(session.now).requests.requests;
  session.run(60s);
  EXPECT_EQ(session.link.status(session.now).requests.requests, requests);
  EXPECT_EQ(session.link.status(session.now).attitude_rate_hz, 0.0);
  EXPECT_GE(*session.link.status(session.now).since_attitude, 119s);

  session.autopilot.character.is_mute = false;
  session.autopilot.reboot(session.now - 500s);  // while nobody listened; its clock is ahead of the old one
  session.run(5s);
  EXPECT_NEAR(session.link.status(session.now).attitude_rate_hz, 10.0, 0.7);
}

TEST(VehicleSession, SynchronisesSoonAndThenOnceASecond) {
  Session session;
  session.run(2s);
  EXPECT_EQ(session.link.status(session.now).clock_source, VehicleClockMap::Source::kRoundTrip);
  session.run(60s);
  EXPECT_NEAR(static_cast<double>(session.autopilot.heard_of(kTimesync).size()), 80.0, 3.0);
  const auto mapped = session.link.clock().to_vehicle(session.now);
  ASSERT_TRUE(mapped);
  EXPECT_LE(std::chrono::abs(*mapped - session.autopilot.clock(session.now)),
            *session.link.clock().error_bound());
  EXPECT_LE(*session.link.clock().error_bound(), 6ms) << "half of the 10 ms that a step takes";
}

TEST(VehicleSession, FallsBackToArrivalsWithoutTimesync) {
  Session session;
  session.autopilot.character.answers_timesync = false;
  session.run(10s);
  EXPECT_EQ(session.link.status(session.now).clock_source, VehicleClockMap::Source::kArrival);
  EXPECT_LE(
      std::chrono::abs(*session.link.clock().to_vehicle(session.now) - session.autopilot.clock(session.now)),
      1ms);
}

/// The first bytes of the frames that a link sends to an autopilot that speaks MAVLink 1.
std::set<int> answers_in_mavlink1(std::uint8_t autopilot) {
  Session session;
  session.autopilot.character.autopilot = autopilot;
  session.run(1500ms);
  EXPECT_TRUE(session.autopilot.heard.back().is_v2);
  testing::FrameFactory old({1, 1}, false);
  const auto frame = old.heartbeat(autopilot);
  session.link.consume(session.now, frame.data(), frame.size(), session.sink);
  std::set<int> begins;
  for (const Duration later : {0s, 1s}) {
    session.link.poll(session.now + later,
                      [&](const std::uint8_t* bytes, std::size_t) { begins.insert(bytes[0]); });
  }
  return begins;
}

TEST(VehicleSession, AnswersAMavlink1LinkInMavlink1) {
  EXPECT_EQ(answers_in_mavlink1(testing::kArduPilot), std::set<int>{0xFE});
}

TEST(VehicleSession, BringsAPx4ToSpeakMavlink2) {
  EXPECT_EQ(answers_in_mavlink1(testing::kPx4), std::set<int>{0xFD});
}

TEST(VehicleSession, ReplayOfItsRecordedFramesGivesTheSameSamplesAndTheSameClock) {
  Session session(MavlinkConfig{});
  session.run(10s);
  session.autopilot.reboot(session.now - 20s);
  session.run(10s);
  session.autopilot.character.is_mute = true;
  session.run(40s);
  session.autopilot.character.is_mute = false;
  session.run(10s);

  VehicleLink replayed({});
  testing::CollectingSink sink;
  for (const auto& frame : session.sink.frames)
    replayed.consume(frame.at, frame.bytes.data(), frame.bytes.size(), sink);

  ASSERT_EQ(sink.attitudes.size(), session.sink.attitudes.size());
  ASSERT_EQ(sink.positions.size(), session.sink.positions.size());
  EXPECT_EQ(sink.attitudes_before_reboot, session.sink.attitudes_before_reboot);
  for (std::size_t i = 0; i < sink.attitudes.size(); ++i) {
    EXPECT_EQ(sink.attitudes[i].time, session.sink.attitudes[i].time);
    EXPECT_EQ(sink.attitudes[i].angles.roll_rad, session.sink.attitudes[i].angles.roll_rad);
  }
  for (std::size_t i = 0; i < sink.positions.size(); ++i) {
    EXPECT_EQ(sink.positions[i].time, session.sink.positions[i].time);
  }
  EXPECT_EQ(replayed.clock().to_vehicle(session.now), session.link.clock().to_vehicle(session.now));
  EXPECT_EQ(replayed.clock().error_bound(), session.link.clock().error_bound());
  EXPECT_EQ(replayed.clock().counts().round_trips, session.link.clock().counts().round_trips);
}

}  // namespace
}  // namespace geoloc::io
