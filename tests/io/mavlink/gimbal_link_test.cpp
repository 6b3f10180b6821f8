// SPDX-License-Identifier: Apache-2.0
// What reaches the estimator of the gimbals of a link.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::FrameFactory;

constexpr HostTime kSwitchedOn{std::chrono::seconds{1'795'300'000}};
constexpr std::uint16_t kFromNose = 32;
constexpr std::uint8_t kGimbal = 154, kSecondGimbal = 171;

/// A vehicle whose clock is 0 at kSwitchedOn, and which tells its attitude ten times a second.
class GimbalLink : public ::testing::Test {
 protected:
  void SetUp() override { hear(vehicle_.heartbeat(), 1s); }

  void hear(const Bytes& frame, Duration after_start) {
    link_.consume(kSwitchedOn + after_start, frame.data(), frame.size(), sink_);
  }

  /// The vehicle alone, until then.
  void fly_until(Duration after_start) {
    for (; flown_ <= after_start; flown_ += 100ms) hear(vehicle_.attitude(VehicleTime{flown_}), flown_);
  }

  static double pitch_deg(const GimbalSample& sample) {
    return euler_angles(sample.level_from_gimbal).pitch_rad * kDegPerRad;
  }

  TelemetryCounts counts() const { return link_.status(kSwitchedOn).telemetry; }

  MavlinkConfig config_;
  VehicleLink link_{config_};
  testing::CollectingSink sink_;
  FrameFactory vehicle_{{1, 1}};
  Duration flown_ = 1s;
};

TEST_F(GimbalLink, DeliversWhatTheAutopilotSaysOfItsGimbalByItsOwnClock) {
  fly_until(2s);
  hear(vehicle_.gimbal_device(VehicleTime{1950ms}, -0.7, kFromNose, 1, 4), 2s);
  ASSERT_EQ(sink_.gimbals.size(), 1U);
  EXPECT_EQ(sink_.gimbals[0].time, VehicleTime{1950ms});
  EXPECT_NEAR(pitch_deg(sink_.gimbals[0]), -0.7 * kDegPerRad, 1e-4);
  const LinkStatus status = link_.status(kSwitchedOn + 2500ms);
  EXPECT_EQ(status.gimbal->number(), 1);
  EXPECT_EQ(status.gimbal_failure_flags, 4U);
  EXPECT_EQ(*status.since_gimbal, 500ms);
}

TEST_F(GimbalLink, PrefersTheMessageThatTellsMostAndTakesALesserOneWhereItEnds) {
  fly_until(1s);
  for (int i = 0; i < 60; ++i) {
    const Duration now = 1s + i * 100ms;
    fly_until(now);
    hear(vehicle_.mount_status(-10.0), now);
    if (i >= 10) hear(vehicle_.mount_orientation(VehicleTime{now}, -20.0), now);
    if (i >= 20 && i < 30) hear(vehicle_.gimbal_device(VehicleTime{now}, -30.0 * kRadPerDeg, kFromNose), now);
  }
  std::vector<int> order;
  for (const GimbalSample& sample : sink_.gimbals) {
    const int pitch = static_cast<int>(std::lround(pitch_deg(sample)));
    if (order.empty() || order.back() != pitch) order.push_back(pitch);
  }
  EXPECT_EQ(order, (std::vector<int>{-10, -20, -30, -10, -20}))
      << "after two seconds any, and of these the better";
}

TEST_F(GimbalLink, ListensToOneDevice) {
  FrameFactory first({1, kGimbal}), second({1, kSecondGimbal}), camera({1, 100}), other_vehicle({2, kGimbal});
  for (int i = 0; i < 30; ++i) {
    const Duration now = 1s + i * 100ms;
    fly_until(now);
    hear(camera.gimbal_device(VehicleTime{now}, -0.1, kFromNose), now);
    hear(other_vehicle.gimbal_device(VehicleTime{now}, -0.2, kFromNose), now);
    hear(first.gimbal_device(VehicleTime{now}, -0.3, kFromNose), now);
    hear(second.gimbal_device(VehicleTime{now}, -0.4, kFromNose), now);
  }
  ASSERT_EQ(sink_.gimbals.size(), 30U);
  for (const GimbalSample& sample : sink_.gimbals) EXPECT_NEAR(pitch_deg(sample), -0.3 * kDegPerRad, 1e-4);
  EXPECT_EQ(counts().other_gimbals, 60U) << "of the camera and the second gimbal";
}

TEST_F(GimbalLink, ListensToTheDeviceThatIsNamed) {
  for (const int number : {2, static_cast<int>(kSecondGimbal)}) {
    config_.gimbal = number;
    link_ = VehicleLink(config_);
    sink_ = {};
    flown_ = 1s;
    hear(vehicle_.heartbeat(), 1s);
    FrameFactory second({1, kSecondGimbal});
    for (int i = 0; i < 20; ++i) {
      const Duration now = 1s + i * 100ms;
      fly_until(now);
      hear(vehicle_.gimbal_device(VehicleTime{now}, -0.1, kFromNose, 1), now);
      hear(vehicle_.gimbal_device(VehicleTime{now}, -0.2, kFromNose, 2), now);
      hear(second.gimbal_device(VehicleTime{now}, -0.3, kFromNose), now);
    }
    ASSERT_EQ(sink_.gimbals.size(), 20U) << number;
    EXPECT_NEAR(pitch_deg(sink_.gimbals.back()), (number == 2 ? -0.2 : -0.3) * kDegPerRad, 1e-4);
    EXPECT_EQ(link_.status(kSwitchedOn).gimbal->number(), number);
  }
}

/// A gimbal counts from its own boot, which says nothing of the vehicle's clock.
TEST_F(GimbalLink, TimesAGimbalWithAClockOfItsOwnByWhenItsMessagesCome) {
  FrameFactory gimbal({1, kGimbal});
  for (int i = 0; i < 50; ++i) {
    const Duration now = 1s + i * 100ms;
    fly_until(now);
    const Duration jitter = i % 5 == 0 ? 0ms : 40ms;  // the link delays most of them
    hear(gimbal.gimbal_device(VehicleTime{now + 777s}, -0.3, kFromNose), now + jitter);
  }
  ASSERT_EQ(sink_.gimbals.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(sink_.gimbals[i].time, VehicleTime{1s + i * 100ms}) << i;
}

TEST_F(GimbalLink, RefusesStampsThatCannotBe) {
  fly_until(4s);
  hear(vehicle_.gimbal_device(VehicleTime{900s}, -0.3, kFromNose), 4s);
  hear(vehicle_.gimbal_device(VehicleTime{6s}, -0.3, kFromNose), 4s);
  hear(vehicle_.mount_orientation(VehicleTime{0s} + 3600s, -30.0), 4s);
  EXPECT_TRUE(sink_.gimbals.empty());
  EXPECT_EQ(counts().suspect_stamps, 3U);
}

/// A replay of a flight with a gimbal that nobody uses must give what it gave before gimbals were read.
TEST_F(GimbalLink, TeachesNothingOfTheVehiclesClock) {
  VehicleLink without{config_};
  testing::CollectingSink sink;
  const auto both_hear = [&](const Bytes& frame, Duration now) {
    hear(frame, now);
    without.consume(kSwitchedOn + now, frame.data(), frame.size(), sink);
  };
  both_hear(vehicle_.heartbeat(), 1s);
  for (int i = 0; i < 100; ++i) {
    const Duration now = 1s + i * 100ms;
    both_hear(vehicle_.attitude(VehicleTime{now - 30ms}), now);
    hear(vehicle_.gimbal_device(VehicleTime{now}, -0.3, kFromNose), now);
  }
  for (const Duration at : {2s, 7s})
    EXPECT_EQ(link_.clock().to_vehicle(kSwitchedOn + at), without.clock().to_vehicle(kSwitchedOn + at));
}

TEST_F(GimbalLink, AsksForAnglesOnlyWhereTheyAreWanted) {
  for (const bool is_wanted : {false, true}) {
    link_ = VehicleLink(config_, is_wanted);
    flown_ = 1s;
    hear(vehicle_.heartbeat(), 1s);
    std::set<int> asked;
    for (int i = 0; i < 300; ++i) {
      const Duration now = 1s + i * 100ms;
      fly_until(now);
      link_.poll(kSwitchedOn + now, [&](const std::uint8_t* frame, std::size_t) {
        constexpr std::uint8_t kCommandLong = 76, kHeader = 10, kV1Header = 6;
        const bool is_v2 = frame[0] == 0xFD;
        if (frame[is_v2 ? 7 : 5] != kCommandLong) return;
        float message_id = 0.0F;
        std::memcpy(&message_id, frame + (is_v2 ? kHeader : kV1Header), sizeof message_id);
        asked.insert(static_cast<int>(message_id));
      });
    }
    EXPECT_EQ(asked.count(285), is_wanted ? 1U : 0U);
    EXPECT_EQ(asked.count(265), is_wanted ? 1U : 0U);
  }
}

}  // namespace
}  // namespace geoloc::io
