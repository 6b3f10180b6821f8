// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/vehicle_link.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/mavlink_fields.hpp"
#include "io/mavlink/test_frames.hpp"
#include "support/allocation_counter.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::FrameFactory;

constexpr HostTime kStart{std::chrono::seconds{1'795'300'000}};
constexpr std::int64_t kMark = 191;  // marks our TIMESYNC requests in the nanoseconds

/// A link on which several systems speak at once; the vehicle's clock is 0 at kStart.
class VehicleLinkTest : public ::testing::Test {
 protected:
  bool hear(const Bytes& frame, Duration after_start) {
    return link_.consume(kStart + after_start, frame.data(), frame.size(), sink_);
  }

  /// A vehicle that has been heard, with its clock at 1 s.
  void meet_vehicle() {
    hear(vehicle_.heartbeat(), 1s);
    hear(vehicle_.attitude(at(1s)), 1s);
    sink_ = {};
  }

  static VehicleTime at(Duration since_boot) { return VehicleTime{since_boot}; }
  TelemetryCounts counts() const { return link_.status(kStart).telemetry; }

  VehicleLink link_{MavlinkConfig{}};
  testing::CollectingSink sink_;
  FrameFactory vehicle_{{1, 1}};
};

TEST_F(VehicleLinkTest, ListensToTheFirstAutopilotOnly) {
  FrameFactory station({255, 190}), camera({1, 100}), other({2, 1});
  EXPECT_FALSE(hear(vehicle_.attitude(at(1s)), 1s)) << "before its heartbeat it is anyone";
  EXPECT_FALSE(hear(station.heartbeat(8, 6), 1s));
  EXPECT_FALSE(hear(camera.heartbeat(testing::kArduPilot), 1s)) << "not the autopilot's component";
  EXPECT_FALSE(link_.status(kStart).vehicle);
  EXPECT_TRUE(hear(vehicle_.heartbeat(), 1s));
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{1, 1}));
  EXPECT_TRUE(hear(vehicle_.attitude(at(1900ms)), 1900ms));

  EXPECT_FALSE(hear(other.heartbeat(), 2s));
  EXPECT_FALSE(hear(other.attitude(at(900s)), 2s));
  EXPECT_FALSE(hear(other.position(at(900s), 1.0, 2.0), 2s));
  EXPECT_FALSE(hear(camera.attitude(at(2s)), 2s));
  EXPECT_TRUE(hear(vehicle_.attitude(at(2s)), 2s));
  EXPECT_EQ(sink_.attitudes.size(), 2U);
  EXPECT_TRUE(sink_.positions.empty());
  EXPECT_EQ(counts().foreign_frames, 7U);
  EXPECT_EQ(counts().vehicle_frames, 3U);
  EXPECT_EQ(sink_.frames.size(), 10U) << "a recording keeps the whole link";
  EXPECT_EQ(link_.status(kStart + 3s).other_system, 2);
  EXPECT_FALSE(link_.status(kStart + 30s).other_system);
}

TEST_F(VehicleLinkTest, AHeartbeatAloneMakesNoVehicleForGood) {
  FrameFactory other({7, 1});
  hear(other.heartbeat(), 1s);
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{7, 1})) << "it is asked for its state";
  hear(vehicle_.heartbeat(), 2s);
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{7, 1})) << "it has its turn";
  EXPECT_TRUE(hear(vehicle_.attitude(at(2100ms)), 2100ms));
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{1, 1}));
  EXPECT_EQ(sink_.attitudes.size(), 1U);
  EXPECT_EQ(sink_.other_vehicles, 0) << "nothing was delivered of the other one";
}

TEST_F(VehicleLinkTest, AutopilotsThatSendNothingUnaskedHaveTheirTurns) {
  FrameFactory other({7, 1});
  std::vector<int> vehicles;
  for (int i = 0; i < 30; ++i) {
    hear(other.heartbeat(), i * 1s);
    hear(vehicle_.heartbeat(), i * 1s + 500ms);
    const int now = link_.status(kStart).vehicle->system;
    if (vehicles.empty() || vehicles.back() != now) vehicles.push_back(now);
  }
  EXPECT_EQ(vehicles, (std::vector<int>{7, 1, 7, 1, 7, 1}));
}

TEST_F(VehicleLinkTest, OneFalseStateMakesNoVehicleForGood) {
  FrameFactory other({7, 1});
  hear(other.heartbeat(), 1s);
  hear(other.gnss(1), 1s);
  hear(other.attitude(at(900s)), 1s);
  for (int i = 0; i < 100; ++i) {
    if (i % 10 == 0) hear(vehicle_.heartbeat(), 1s + i * 100ms);
    hear(vehicle_.attitude(at(1s + i * 100ms)), 1s + i * 100ms);
    hear(vehicle_.position(at(1s + i * 100ms), 47.0, 8.0), 1s + i * 100ms);
  }
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{1, 1}));
  EXPECT_EQ(sink_.other_vehicles, 1);
  EXPECT_GE(sink_.positions.size(), 65U) << "all but those of the first three seconds";
  EXPECT_NEAR(seconds(*link_.clock().to_vehicle(kStart + 10s) - at(10s)), 0.0, 1e-3);
}

TEST_F(VehicleLinkTest, AVehicleThatHasProvenItselfStaysTheVehicle) {
  FrameFactory other({7, 1});
  hear(vehicle_.heartbeat(), 1s);
  for (int i = 0; i <= 31; ++i) hear(vehicle_.attitude(at(1s + i * 100ms)), 1s + i * 100ms);
  for (int i = 0; i < 600; ++i) {
    hear(other.heartbeat(), 5s + i * 100ms);
    hear(other.attitude(at(1s + i * 100ms)), 5s + i * 100ms);
  }
  EXPECT_EQ(link_.status(kStart).vehicle, (MavAddress{1, 1}));
  EXPECT_EQ(sink_.attitudes.size(), 32U);
  EXPECT_EQ(link_.status(kStart + 60s).other_system, 7);
}

TEST_F(VehicleLinkTest, WaitsForTheConfiguredSystem) {
  MavlinkConfig config;
  config.system_id = 2;
  VehicleLink link(config);
  FrameFactory second({2, 1});
  const Bytes first_heartbeat = vehicle_.heartbeat(), second_heartbeat = second.heartbeat();
  EXPECT_FALSE(link.consume(kStart, first_heartbeat.data(), first_heartbeat.size(), sink_));
  EXPECT_FALSE(link.status(kStart).vehicle);
  EXPECT_EQ(link.status(kStart).other_system, 1);
  EXPECT_TRUE(link.consume(kStart, second_heartbeat.data(), second_heartbeat.size(), sink_));
}

TEST_F(VehicleLinkTest, KeepsPositionsBackUntilTheVehicleKnowsWhereItIs) {
  meet_vehicle();
  hear(vehicle_.position(at(1s), 0.0, 0.0), 1s);
  EXPECT_EQ(counts().no_fix_positions, 1U);
  hear(vehicle_.position(at(1100ms), 47.0, 8.0), 1100ms);
  EXPECT_EQ(sink_.positions.size(), 1U) << "a link without GPS_RAW_INT and EKF_STATUS_REPORT works";
  hear(vehicle_.gnss(1), 1100ms);
  hear(vehicle_.position(at(1200ms), 47.0, 8.0), 1200ms);
  EXPECT_EQ(counts().no_fix_positions, 2U);
  hear(vehicle_.gnss(3, 0.85), 1200ms);
  hear(vehicle_.position(at(1300ms), 47.0, 8.0), 1300ms);
  EXPECT_EQ(sink_.positions.size(), 2U);
  EXPECT_EQ(sink_.positions.back().sigma_horizontal_m, 0.85);
  for (const int flags : {1024, 0, 167}) {  // the states ArduPilot goes through
    hear(vehicle_.ekf_status(static_cast<std::uint16_t>(flags)), 1300ms);
    hear(vehicle_.position(at(1400ms), 47.0, 8.0), 1400ms);
  }
  EXPECT_EQ(counts().no_fix_positions, 5U);
  hear(vehicle_.ekf_status(831), 1400ms);
  hear(vehicle_.position(at(1500ms), 47.0, 8.0, 12.5), 1500ms);
  ASSERT_EQ(sink_.positions.size(), 3U);
  EXPECT_EQ(sink_.positions.back().time, at(1500ms));
  EXPECT_DOUBLE_EQ(sink_.positions.back().height_above_home_m, 12.5);
}

TEST_F(VehicleLinkTest, AVetoThatIsNotRepeatedLapses) {
  meet_vehicle();
  hear(vehicle_.ekf_status(0), 1s);
  hear(vehicle_.position(at(5900ms), 47.0, 8.0), 5900ms);
  EXPECT_TRUE(sink_.positions.empty());
  EXPECT_EQ(link_.status(kStart + 5900ms).position_refusal, PositionRefusal::kNoAbsolutePosition);
  hear(vehicle_.gnss(1), 6s);
  hear(vehicle_.position(at(6100ms), 47.0, 8.0), 6100ms);
  EXPECT_EQ(link_.status(kStart + 6100ms).position_refusal, PositionRefusal::kNoFix);
  hear(vehicle_.attitude(at(9s)), 9s);
  hear(vehicle_.position(at(11100ms), 47.0, 8.0), 11100ms);
  EXPECT_EQ(sink_.positions.size(), 1U);
  EXPECT_FALSE(link_.status(kStart + 11100ms).position_refusal);
  hear(vehicle_.position(at(11200ms), 0.0, 0.0), 11200ms);
  EXPECT_EQ(link_.status(kStart + 11200ms).position_refusal, PositionRefusal::kNoPlace);
}

TEST_F(VehicleLinkTest, OneFalseAccuracyAmongOthersHasNoEffect) {
  meet_vehicle();
  std::vector<std::optional<double>> told;
  for (const double h_acc_m : {0.8, 5000.0, 0.9, 0.7, 0.001, 0.8, 0.0, 0.6}) {
    const Duration now = 2s + told.size() * 500ms;
    hear(vehicle_.gnss(3, h_acc_m), now);
    hear(vehicle_.position(at(now), 47.0, 8.0), now);
    told.push_back(sink_.positions.back().sigma_horizontal_m);
  }
  EXPECT_EQ(told, (std::vector<std::optional<double>>{0.8, 0.8, 0.9, 0.9, 0.7, 0.7, std::nullopt, 0.6}));
  for (const Duration now : {8s, 11s}) hear(vehicle_.attitude(at(now)), now);
  hear(vehicle_.position(at(11100ms), 47.0, 8.0), 11100ms);
  EXPECT_FALSE(sink_.positions.back().sigma_horizontal_m) << "nothing has been told for long";
}

TEST_F(VehicleLinkTest, TellsAGlitchOfEitherEstimator) {
  meet_vehicle();
  const auto has_glitch = [&] { return link_.status(kStart + 2s).has_gnss_glitch; };
  hear(vehicle_.ekf_status(831 | 1024), 2s);  // its other bit of this number has another meaning
  EXPECT_FALSE(has_glitch());
  hear(vehicle_.ekf_status(831 | 32768), 2s);
  EXPECT_TRUE(has_glitch());
  hear(vehicle_.estimator_status(831), 2s);
  EXPECT_FALSE(has_glitch());
  hear(vehicle_.estimator_status(831 | 1024), 2s);
  EXPECT_TRUE(has_glitch());
  EXPECT_FALSE(link_.status(kStart + 20s).has_gnss_glitch);
}

TEST_F(VehicleLinkTest, TakesTheEstimatorsAccuracyWhereTheReceiverClaimsNoneOrIsNotBelieved) {
  constexpr std::uint16_t kFine = 831, kGlitch = 831 | 1024, kConstantPosition = 229;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  meet_vehicle();
  Duration now = 2s;
  const auto told = [&](const Bytes& status) {
    now += 500ms;
    hear(status, now);
    hear(vehicle_.position(at(now), 47.0, 8.0), now);
    return sink_.positions.empty() ? std::nullopt : sink_.positions.back().sigma_horizontal_m;
  };
  EXPECT_EQ(told(vehicle_.estimator_status(kConstantPosition, 0.5F)), std::nullopt);
  EXPECT_TRUE(sink_.positions.empty()) << "a PX4 on the ground without a fix claims half a metre";
  EXPECT_EQ(told(vehicle_.estimator_status(kFine, 2.0F)), 2.0);
  for (const float nothing : {0.0F, -1.0F, kNan, kInf})
    EXPECT_EQ(told(vehicle_.estimator_status(kFine, nothing)), std::nullopt) << nothing;
  EXPECT_EQ(told(vehicle_.estimator_status(kFine, 2.0F)), 2.0);
  EXPECT_EQ(told(vehicle_.estimator_status(kFine, 900.0F)), 2.0) << "one false claim has no effect";
  EXPECT_EQ(told(vehicle_.gnss(3, 0.8)), 0.8) << "a filter is surer than its receiver, and no better";
  EXPECT_EQ(told(vehicle_.estimator_status(kGlitch, 2.0F)), 2.0) << "the receiver is not believed";
  for (int i = 0; i < 3; ++i) told(vehicle_.gnss(3, 3.5));
  EXPECT_EQ(sink_.positions.back().sigma_horizontal_m, 3.5);
  EXPECT_EQ(told(vehicle_.estimator_status(kFine, 2.0F)), 3.5);
}

TEST_F(VehicleLinkTest, DropsASampleThatComesBeforeItsStamp) {
  meet_vehicle();
  for (int i = 0; i < 40; ++i) hear(vehicle_.attitude(at(1s + i * 100ms)), 1s + i * 100ms);
  const std::size_t before = sink_.attitudes.size();
  hear(vehicle_.attitude(at(9800ms)), 5s);
  EXPECT_EQ(sink_.attitudes.size(), before);
  EXPECT_EQ(counts().suspect_stamps, 1U);
  hear(vehicle_.attitude(at(5s)), 5s);
  EXPECT_EQ(sink_.attitudes.size(), before + 1);
  EXPECT_EQ(link_.clock().doubt(), Duration::zero());
  for (int i = 0; i < 3; ++i) hear(vehicle_.attitude(at(9s + i * 100ms)), 5100ms + i * 100ms);
  EXPECT_EQ(sink_.clock_steps.size(), 1U) << "three in a row: the clock has stepped";
  EXPECT_EQ(sink_.attitudes.size(), before + 2) << "the third is of the new clock";
}

TEST_F(VehicleLinkTest, TakesQuaternionsOnlyWhereThereAreNoAngles) {
  meet_vehicle();
  hear(vehicle_.attitude(at(2s)), 2s);
  hear(vehicle_.attitude_quaternion(at(2s)), 2s);
  EXPECT_EQ(sink_.attitudes.size(), 1U);
  EXPECT_EQ(counts().second_attitudes, 1U);
  hear(vehicle_.attitude_quaternion(at(3500ms)), 3500ms);
  EXPECT_EQ(sink_.attitudes.size(), 2U);
}

TEST_F(VehicleLinkTest, TakesDistancesOfSensorsThatLookDownAndMeasure) {
  meet_vehicle();
  hear(vehicle_.distance_sensor(at(2s), 12.34), 2s);
  ASSERT_EQ(sink_.ranges.size(), 1U);
  EXPECT_EQ(sink_.ranges[0].time, at(2s));
  EXPECT_DOUBLE_EQ(sink_.ranges[0].distance_m, 12.34);
  constexpr std::uint8_t kForward = 0, kDown = 25, kInvalid = 1, kGood = 90;
  hear(vehicle_.distance_sensor(at(2s), 12.0, kForward), 2s);
  hear(vehicle_.distance_sensor(at(2s), 12.0, kDown, kInvalid), 2s);
  hear(vehicle_.distance_sensor(at(2s), 0.2), 2s);
  hear(vehicle_.distance_sensor(at(2s), 40.0), 2s);
  hear(vehicle_.distance_sensor(at(2s), 655.35), 2s);
  EXPECT_EQ(sink_.ranges.size(), 1U);
  hear(vehicle_.distance_sensor(at(2100ms), 12.0, kDown, kGood), 2100ms);
  EXPECT_EQ(sink_.ranges.size(), 2U);
  EXPECT_EQ(counts().ranges, 2U);
}

TEST_F(VehicleLinkTest, TakesDistancesWithoutATimeOnlyWhereNoOthersCome) {
  meet_vehicle();
  hear(vehicle_.attitude(at(1s)), 1s);
  hear(vehicle_.rangefinder(7.5), 1100ms);
  ASSERT_EQ(sink_.ranges.size(), 1U);
  EXPECT_NEAR(seconds(sink_.ranges[0].time - at(1100ms)), 0.0, 0.05);
  hear(vehicle_.distance_sensor(at(1200ms), 7.5), 1200ms);
  hear(vehicle_.rangefinder(7.5), 1300ms);
  EXPECT_EQ(sink_.ranges.size(), 2U);
  hear(vehicle_.rangefinder(7.5), 3300ms);
  EXPECT_EQ(sink_.ranges.size(), 3U);
  hear(vehicle_.rangefinder(0.0), 3400ms);
  hear(vehicle_.rangefinder(-1.0), 3400ms);
  EXPECT_EQ(sink_.ranges.size(), 3U);
  hear(vehicle_.rangefinder(std::numeric_limits<double>::quiet_NaN()), 3400ms);
  EXPECT_EQ(counts().refused_values, 1U);
}

TEST_F(VehicleLinkTest, RefusesValuesThatCannotBe) {
  meet_vehicle();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  hear(vehicle_.attitude(at(2s), nan), 2s);
  hear(vehicle_.attitude(at(2s), 0.0, 1e9), 2s);
  hear(vehicle_.position(at(2s), 91.0, 0.0), 2s);
  hear(vehicle_.position(at(2s), 1.0, 181.0), 2s);
  hear(vehicle_.position(at(2s), 1.0, 1.0, 2e5), 2s);
  EXPECT_EQ(counts().refused_values, 5U);
  EXPECT_TRUE(sink_.attitudes.empty());
  EXPECT_TRUE(sink_.positions.empty());
}

TEST_F(VehicleLinkTest, TellsOfARebootBeforeTheFirstSampleOfTheNewClock) {
  meet_vehicle();
  hear(vehicle_.gnss(3), 1s);
  hear(vehicle_.attitude(at(279s)), 2s);
  hear(vehicle_.attitude(at(279s)), 2s);
  hear(vehicle_.attitude(at(279s)), 2s);
  sink_ = {};
  for (int i = 0; i < 5; ++i) hear(vehicle_.attitude(at(19s + i * 100ms)), 12s + i * 100ms);
  EXPECT_EQ(sink_.reboots_at.size(), 1U);
  EXPECT_EQ(sink_.attitudes_before_reboot, std::vector<std::size_t>{0});
  EXPECT_EQ(sink_.attitudes.size(), 3U);
  EXPECT_FALSE(link_.status(kStart).fix_type) << "what was known of the receiver is forgotten";
  EXPECT_NEAR(seconds(*link_.clock().to_vehicle(kStart + 13s) - at(20s)), 0.0, 1e-3);
}

TEST_F(VehicleLinkTest, ReadsTheClockFromItsOwnRoundTripsAlone) {
  meet_vehicle();
  const auto host_ns = [](Duration after_start) { return (kStart + after_start).time_since_epoch().count(); };
  const auto refused = [&] { return link_.clock().counts().refused_round_trips; };
  hear(vehicle_.timesync(1'000'000'000, host_ns(1s) + kMark + 1), 1010ms);
  hear(vehicle_.timesync(1'000'000'000, host_ns(1s)), 1010ms);
  hear(vehicle_.timesync(0, host_ns(1s) + kMark), 1010ms);
  EXPECT_EQ(counts().foreign_timesyncs, 3U);
  for (const std::int64_t absurd : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                    std::numeric_limits<std::int64_t>::max()}) {
    hear(vehicle_.timesync(absurd, host_ns(1s) + kMark), 1010ms);
  }
  EXPECT_EQ(refused(), 3U);
  hear(vehicle_.timesync(1'000'000'000, host_ns(3s) + kMark), 1010ms);
  hear(vehicle_.timesync(1'000'000'000, kMark), 1010ms);
  hear(vehicle_.timesync(1'000'000'000, std::numeric_limits<std::int64_t>::max()), 1010ms);
  hear(vehicle_.timesync(1'000'000'000, std::numeric_limits<std::int64_t>::min()), 1010ms);
  hear(vehicle_.timesync(900'000'000'000, host_ns(1s) + kMark), 1010ms);
  EXPECT_EQ(refused(), 6U) << "from the future, an hour old, another clock than the stamps'";
  EXPECT_EQ(counts().foreign_timesyncs, 5U);
  EXPECT_EQ(link_.clock().counts().round_trips, 0U);

  for (int i = 0; i < 4; ++i) {
    hear(
        vehicle_.timesync(host_ns(1s + i * 100ms) - host_ns(0s) + 5'000'000, host_ns(1s + i * 100ms) + kMark),
        1010ms + i * 100ms);
  }
  EXPECT_EQ(link_.clock().counts().round_trips, 4U);
  EXPECT_EQ(link_.clock().source(), VehicleClockMap::Source::kRoundTrip);
  EXPECT_EQ(link_.clock().to_vehicle(kStart + 5s), at(5s));
}

TEST_F(VehicleLinkTest, LeavesAnswersToOthersAlone) {
  meet_vehicle();
  const std::int64_t asked_ns = (kStart + 1s).time_since_epoch().count() + kMark;
  const Bytes to_station = vehicle_.timesync_to({255, 190}, 1'005'000'000, asked_ns);
  const Bytes to_us = vehicle_.timesync_to({1, 191}, 1'005'000'000, asked_ns);
  hear(to_station, 1010ms);
  EXPECT_EQ(counts().foreign_timesyncs, 1U);
  EXPECT_EQ(link_.clock().counts().round_trips, 0U);
  hear(to_us, 1010ms);
  EXPECT_EQ(link_.clock().counts().round_trips, 1U);
}

TEST(VehicleLink, DoesNotAllocateOnceItKnowsTheVehicle) {
  struct NullSink : TelemetrySink {
    void on_attitude(const AttitudeSample&) override {}
    void on_position(const PositionSample&) override {}
    void on_reboot() override {}
    void on_clock_step(Duration) override {}
    void on_frame(HostTime, const std::uint8_t*, std::size_t) override {}
  } sink;
  FrameFactory vehicle({1, 1});
  VehicleLink link{MavlinkConfig{}};
  Bytes stream = vehicle.heartbeat();
  link.consume(kStart, stream.data(), stream.size(), sink);
  stream.assign(50, 0xFE);
  for (int i = 0; i < 100; ++i) {
    const VehicleTime time{10s + i * 10ms};
    for (const Bytes& frame :
         {vehicle.attitude(time), vehicle.position(time, 1.0, 2.0), vehicle.system_time(time)}) {
      stream.insert(stream.end(), frame.begin(), frame.end());
    }
  }
  const std::size_t before = geoloc::testing::allocations();
  link.consume(kStart + 10s, stream.data(), stream.size(), sink);
  link.poll(kStart + 12s, [](const std::uint8_t*, std::size_t) {});
  EXPECT_EQ(geoloc::testing::allocations(), before);
  EXPECT_EQ(link.status(kStart).telemetry.attitudes, 100U);
}

TEST(MavlinkConfig, NamesEveryFault) {
  MavlinkConfig config;
  EXPECT_TRUE(config.problems().empty());
  config.system_id = 256;
  config.component_id = 1;
  config.attitude_rate_hz = 0.0;
  config.position_rate_hz = std::numeric_limits<double>::quiet_NaN();
  config.link_timeout_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(config.problems().size(), 5U);
  EXPECT_THROW(VehicleLink{config}, std::invalid_argument);
}

TEST(MavlinkConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(geoloc::testing::expect_bounds_are_kept<MavlinkConfig>(), 0U);
}

}  // namespace
}  // namespace geoloc::io
