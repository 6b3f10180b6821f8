// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/gimbal_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "sim/flights_for_test.hpp"
#include "sim/live/heard_messages.hpp"

namespace geoloc::sim {
namespace {

using HeardGimbal = Heard<io::GimbalMessage>;

std::vector<HeardGimbal> hear_gimbals(const Flight& flight) {
  return hear<io::GimbalMessage>(flight);
}

/// The same axes as the truth's, in level axes with x to the nose or to the local frame's north.
Eigen::Quaterniond true_level_from_gimbal(const Flight& flight, VehicleTime time, GimbalYaw from) {
  const Eigen::Quaterniond ned_from_gimbal = enu_from_ned() * flight.gimbal->enu_from_gimbal(time);
  if (from == GimbalYaw::kFromNorth) return ned_from_gimbal;
  const double yaw_rad = euler_angles(enu_from_ned() * flight.truth.pose(time)->rotation).yaw_rad;
  return Eigen::AngleAxisd(-yaw_rad, Eigen::Vector3d::UnitZ()) * ned_from_gimbal;
}

/// But for its own noise; from north, also but for what the autopilot's yaw is off by.
TEST(SimulatedGimbal, TellsHowItIsTurnedTenTimesASecond) {
  const Flight recorded = load("stock_path1");
  for (const GimbalTelling telling :
       {GimbalTelling::kDeviceStatus, GimbalTelling::kMountOrientation, GimbalTelling::kMountStatus}) {
    for (const GimbalYaw from : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
      if (telling == GimbalTelling::kMountStatus && from == GimbalYaw::kFromNorth) continue;
      GimbalSettings settings;
      settings.aim = GimbalAim::kSweep;
      settings.told_yaw = from;
      settings.telling = telling;
      const Flight flight = with_gimbal(recorded, settings, 3);
      const std::vector<HeardGimbal> heard = hear_gimbals(flight);
      const TimeSpan span = flight.truth.span();
      EXPECT_NEAR(static_cast<double>(heard.size()), 10.0 * seconds(span.end - span.begin), 2.0);
      double sum_rad2 = 0.0;
      for (const HeardGimbal& one : heard) {
        const VehicleTime time =
            one.message.has_time ? one.message.sample.time : VehicleTime{one.at - flight.booted_at};
        const double off_rad =
            one.message.sample.level_from_gimbal.angularDistance(true_level_from_gimbal(flight, time, from));
        EXPECT_EQ(one.message.sample.yaw, from);
        sum_rad2 += off_rad * off_rad;
      }
      const double rms_deg = std::sqrt(sum_rad2 / static_cast<double>(heard.size())) * kDegPerRad;
      EXPECT_GT(rms_deg, 0.05);
      EXPECT_LT(rms_deg, from == GimbalYaw::kFromNose ? 0.2 : 1.5);
    }
  }
}

TEST(SimulatedGimbal, LooksWhereItIsAimedAndKeepsWithinItsLimits) {
  const Flight recorded = load("stock_path1");
  for (const GimbalAim aim : {GimbalAim::kNadir, GimbalAim::kOblique, GimbalAim::kSweep}) {
    for (const bool holds : {false, true}) {
      GimbalSettings settings;
      settings.aim = aim;
      settings.holds_direction = holds;
      const Flight flight = with_gimbal(recorded, settings, 3);
      const TimeSpan survey = flight.truth.survey();
      double least_deg = 0.0, most_deg = -180.0;
      for (VehicleTime time = survey.begin; time < survey.end; time += std::chrono::milliseconds{70}) {
        const Eigen::Vector3d ahead = flight.gimbal->enu_from_gimbal(time) * Eigen::Vector3d::UnitX();
        const double up_deg = std::asin(std::clamp(ahead.z(), -1.0, 1.0)) * kDegPerRad;
        least_deg = std::min(least_deg, up_deg);
        most_deg = std::max(most_deg, up_deg);
      }
      const double low = aim == GimbalAim::kOblique ? -45.0 : -90.0;
      const double high = aim == GimbalAim::kNadir ? -90.0 : aim == GimbalAim::kOblique ? -45.0 : -40.0;
      EXPECT_NEAR(least_deg, low, 2.0);
      EXPECT_NEAR(most_deg, high, 2.0);
    }
  }
}

TEST(SimulatedGimbal, ChangesNothingElseAndDependsOnTheSeed) {
  const Flight recorded = load("stock_path1");
  const Flight first = with_gimbal(recorded, {}, 3), again = with_gimbal(recorded, {}, 3),
               other = with_gimbal(recorded, {}, 4);
  EXPECT_EQ(first.telemetry.records().size() - hear_gimbals(first).size(),
            recorded.telemetry.records().size());
  const VehicleTime time = first.truth.survey().begin;
  EXPECT_EQ(first.gimbal->enu_from_gimbal(time).coeffs(), again.gimbal->enu_from_gimbal(time).coeffs());
  EXPECT_NE(first.gimbal->enu_from_gimbal(time).coeffs(), other.gimbal->enu_from_gimbal(time).coeffs());
}

TEST(SimulatedGimbal, WithAWrongFlagTellsTheSameAnglesUnderTheOtherName) {
  const Flight recorded = load("stock_path1");
  for (const GimbalTelling telling : {GimbalTelling::kDeviceStatus, GimbalTelling::kMountOrientation}) {
    GimbalSettings settings;
    settings.telling = telling;
    const std::vector<HeardGimbal> right = hear_gimbals(with_gimbal(recorded, settings, 3));
    settings.has_wrong_flag = true;
    const std::vector<HeardGimbal> wrong = hear_gimbals(with_gimbal(recorded, settings, 3));
    ASSERT_EQ(right.size(), wrong.size());
    for (std::size_t i = 0; i < right.size(); i += 50) {
      EXPECT_EQ(right[i].message.sample.level_from_gimbal.coeffs(),
                wrong[i].message.sample.level_from_gimbal.coeffs());
      EXPECT_NE(right[i].message.sample.yaw, wrong[i].message.sample.yaw);
    }
  }
}

TEST(SimulatedGimbal, ThatIsPerfectTellsHowItIsTurned) {
  GimbalSettings settings;
  settings.aim = GimbalAim::kSweep;
  settings.is_perfect = true;
  const Flight flight = with_gimbal(load("stock_path1"), settings, 3);
  for (const HeardGimbal& one : hear_gimbals(flight)) {
    const Eigen::Quaterniond truth =
        true_level_from_gimbal(flight, one.message.sample.time, GimbalYaw::kFromNose);
    EXPECT_LT(one.message.sample.level_from_gimbal.angularDistance(truth), 1e-3);  // told by floats
  }
}

TEST(SimulatedGimbal, ThatTellsItsSetPointTellsItWithoutNoise) {
  GimbalSettings settings;
  settings.tells_set_point = true;
  const Flight flight = with_gimbal(load("stock_path1"), settings, 3);
  const std::vector<HeardGimbal> heard = hear_gimbals(flight);
  const Eigen::Quaterniond down = ned_from_body({0.0, -0.5 * kPi, 0.0});
  for (const HeardGimbal& one : heard)
    EXPECT_LT(one.message.sample.level_from_gimbal.angularDistance(down), 1e-3);
  const VehicleTime time = flight.truth.survey().begin;
  EXPECT_GT(true_level_from_gimbal(flight, time, GimbalYaw::kFromNose).angularDistance(down), 1e-4);
}

}  // namespace
}  // namespace geoloc::sim
