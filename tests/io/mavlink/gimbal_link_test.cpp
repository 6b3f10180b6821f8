// SPDX-License-Identifier: Apache-2.0
// What reaches the estimator of the gimbals of a link.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/component_link.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::FrameFactory;

constexpr std::uint16_t kFromNose = 32;
constexpr std::uint8_t kGimbal = 154, kSecondGimbal = 171;

class GimbalLink : public testing::ComponentLink {
 protected:
  static double pitch_deg(const GimbalSample& sample) {
    return euler_angles(sample.level_from_gimbal).pitch_rad * kDegPerRad;
  }
};

TEST_F(GimbalLink, DeliversWhatTheAutopilotSaysOfItsGimbalByItsOwnClock) {
  fly_until(2s);
  hear(vehicle_.gimbal_device(VehicleTime{1950ms}, -0.7, kFromNose, 1, 4), 2s);
  ASSERT_EQ(sink_.gimbals.size(), 1U);
  EXPECT_EQ(sink_.gimbals[0].time, VehicleTime{1950ms});
  EXPECT_NEAR(pitch_deg(sink_.gimbals[0]), -0.7 * kDegPerRad, 1e-4);
  const LinkStatus later = status(2500ms);
  EXPECT_EQ(later.gimbal->number(), 1);
  EXPECT_EQ(later.gimbal_failure_flags, 4U);
  EXPECT_EQ(*later.since_gimbal, 500ms);
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
    EXPECT_EQ(status(0s).gimbal->number(), number);
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

TEST_F(GimbalLink, TeachesNothingOfTheVehiclesClock) {
  expect_clock_untaught([&](VehicleTime now) { return vehicle_.gimbal_device(now, -0.3, kFromNose); });
}

TEST_F(GimbalLink, AsksForAnglesOnlyWhereTheyAreWanted) {
  constexpr std::pair<int, int> kDeviceAttitude{285, 1}, kMountOrientation{265, 1};
  for (const bool is_wanted : {false, true}) {
    begin_anew(is_wanted);
    const auto requests = asked();
    EXPECT_EQ(requests.count(kDeviceAttitude), is_wanted ? 1U : 0U);
    EXPECT_EQ(requests.count(kMountOrientation), is_wanted ? 1U : 0U);
  }
}

}  // namespace
}  // namespace geoloc::io
