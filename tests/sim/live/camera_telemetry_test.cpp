// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/camera_telemetry.hpp"

#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/live/gimbal_flight.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kRelease{std::chrono::seconds{1'800'000'000}};

EulerAngles true_angles(const Flight& flight, VehicleTime time) {
  return euler_angles(enu_from_ned() * flight.truth.pose(time).value().rotation);
}

TEST(CameraTelemetry, TellsTheStateThatWasSoAtItsAge) {
  const Flight flight = load("stock_path1");
  for (const double speed : {1.0, 4.0}) {
    FlightClock clock(flight.truth.survey(), speed);
    clock.release(kRelease);
    const CameraTelemetry camera(flight, clock, CameraIntrinsics{});
    for (HostTime stamp = kRelease + 1s; stamp < kRelease + 10s; stamp += 333ms) {
      const io::VideoTelemetry told = camera.at(stamp);
      ASSERT_TRUE(told.vehicle && told.position && told.velocity);
      EXPECT_FALSE(told.gimbal);
      EXPECT_EQ(told.made_at.time_since_epoch(), stamp.time_since_epoch());
      EXPECT_LT(told.vehicle->age, 300ms);
      const VehicleTime then = clock.flight_time(stamp - told.position->age);
      const Eigen::Vector3d truth = flight.truth.pose(then).value().translation;
      const auto here = flight.truth.frame().to_local(told.position->position).position_in_enu;
      EXPECT_LT((here - truth.head<2>()).norm(), 2.0);
      const EulerAngles angles = true_angles(flight, clock.flight_time(stamp - told.vehicle->age));
      EXPECT_NEAR(told.vehicle->angles.roll_rad, angles.roll_rad, 3.0 * kRadPerDeg);
      EXPECT_NEAR(told.vehicle->angles.pitch_rad, angles.pitch_rad, 3.0 * kRadPerDeg);
    }
  }
}

TEST(CameraTelemetry, WhileTheFlightWaitsThePoseStandsStillAndIsNew) {
  const Flight flight = load("stock_path1");
  const FlightClock clock(flight.truth.survey(), 1.0);
  const CameraTelemetry camera(flight, clock, CameraIntrinsics{});
  const io::VideoTelemetry told = camera.at(kRelease);
  ASSERT_TRUE(told.vehicle && told.position && told.velocity);
  EXPECT_EQ(told.vehicle->age, Duration{});
  EXPECT_EQ(told.position->age, Duration{});
  EXPECT_EQ(told.velocity->velocity_in_enu.norm(), 0.0);
  EXPECT_EQ(to_json(camera.at(kRelease + 1s)).substr(70), to_json(told).substr(70));  // but for the time
}

TEST(CameraTelemetry, TheGimbalsYawCountsFromTheNoseWhateverItsMessageSays) {
  for (const GimbalYaw origin : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
    GimbalSettings settings;
    settings.aim = GimbalAim::kOblique;
    settings.told_yaw = origin;
    const Flight flight = with_gimbal(load("stock_path1"), settings, 1);
    FlightClock clock(flight.truth.survey(), 1.0);
    clock.release(kRelease);
    const CameraTelemetry camera(flight, clock, CameraIntrinsics{});
    const io::VideoTelemetry told = camera.at(kRelease + 20s);
    ASSERT_TRUE(told.gimbal);
    EXPECT_NEAR(told.gimbal->angles.pitch_rad, -45.0 * kRadPerDeg, 1.0 * kRadPerDeg);
    EXPECT_NEAR(told.gimbal->angles.roll_rad, 0.0, 1.0 * kRadPerDeg);
    EXPECT_LT(std::abs(told.gimbal->angles.yaw_rad), 30.0 * kRadPerDeg);
  }
}

}  // namespace
}  // namespace geoloc::sim
