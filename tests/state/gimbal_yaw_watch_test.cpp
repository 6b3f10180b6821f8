// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/gimbal_yaw_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"

namespace geoloc {
namespace {

/// To the north for ten seconds, then to the east within two, and so on: a survey there and back.
double surveying_yaw_rad(double time_s) {
  constexpr double kLeg_s = 10.0, kTurn_s = 2.0;
  const double legs = std::floor(time_s / (kLeg_s + kTurn_s));
  const double into_turn = std::clamp((time_s - legs * (kLeg_s + kTurn_s) - kLeg_s) / kTurn_s, 0.0, 1.0);
  const bool comes_back = std::fmod(legs, 4.0) >= 2.0;
  const double base = std::fmod(legs, 4.0) < 2.0 ? std::fmod(legs, 4.0) : 4.0 - std::fmod(legs, 4.0);
  return 0.5 * kPi * (base + (comes_back ? -into_turn : into_turn));
}

struct Kind {
  bool holds_direction;
  GimbalYaw truly_from;
  double pitch_deg;
  double aim_deg = 40.0;  ///< the direction it holds, or how far from the nose it looks
};

/// Whether the flags are found wrong, and after how long [s].
std::optional<double> noticed_after_s(const Kind& kind, GimbalYaw told, std::optional<bool> says_it_holds,
                                      const std::function<double(double)>& operators_turn_rad = {}) {
  GimbalYawWatch watch;
  for (double time_s = 0.0; time_s < 120.0; time_s += 0.1) {
    const double vehicle_rad = surveying_yaw_rad(time_s);
    const double from_north_rad =
        (kind.holds_direction ? 0.0 : surveying_yaw_rad(std::max(0.0, time_s - 0.4))) +
        kind.aim_deg * kRadPerDeg + (operators_turn_rad ? operators_turn_rad(time_s) : 0.0);
    const double yaw_rad =
        kind.truly_from == GimbalYaw::kFromNorth ? from_north_rad : from_north_rad - vehicle_rad;
    watch.observe({VehicleTime{from_seconds(time_s)},
                   ned_from_body({0.0, kind.pitch_deg * kRadPerDeg, yaw_rad}), told, says_it_holds},
                  vehicle_rad);
    if (watch.is_told_wrong()) return time_s;
  }
  return std::nullopt;
}

GimbalYaw other(GimbalYaw yaw) {
  return yaw == GimbalYaw::kFromNose ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
}

TEST(GimbalYawWatch, FindsEveryWrongFlagByTheFirstTurnsAndDoubtsNoRightOne) {
  for (const bool holds : {false, true}) {
    for (const GimbalYaw truly_from : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
      for (const double pitch_deg : {-90.0, -45.0, 0.0}) {
        const Kind kind{holds, truly_from, pitch_deg};
        EXPECT_FALSE(noticed_after_s(kind, truly_from, holds)) << holds << pitch_deg;
        const auto wrong_after_s = noticed_after_s(kind, other(truly_from), holds);
        ASSERT_TRUE(wrong_after_s) << holds << pitch_deg;
        EXPECT_LT(*wrong_after_s, 16.0) << "one turn of 90 deg, from 10 s to 12 s, tells";
      }
    }
  }
}

TEST(GimbalYawWatch, ConcludesNothingFromAYawThatStaysIfTheGimbalDoesNotSayWhetherItFollows) {
  for (const GimbalYaw told : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
    EXPECT_FALSE(noticed_after_s({false, GimbalYaw::kFromNose, -45.0}, told, std::nullopt));
    EXPECT_FALSE(noticed_after_s({true, GimbalYaw::kFromNorth, -45.0}, told, std::nullopt));
  }
}

/// Flags that every message of some gimbals has set: a camera that looks ahead follows the nose.
TEST(GimbalYawWatch, BelievesACameraThatLooksAheadToFollowTheNoseEvenIfItSaysItIsLocked) {
  EXPECT_FALSE(noticed_after_s({false, GimbalYaw::kFromNose, -45.0, 0.0}, GimbalYaw::kFromNose, true));
}

TEST(GimbalYawWatch, IsNotMisledByAnOperatorWhoTurnsTheCamera) {
  const auto sweeping = [](double time_s) { return 0.8 * std::sin(0.5 * time_s); };
  const auto panning = [](double time_s) { return 0.2 * time_s; };
  for (const bool holds : {false, true}) {
    for (const GimbalYaw from : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
      EXPECT_FALSE(noticed_after_s({holds, from, -60.0}, from, holds, sweeping)) << holds;
      EXPECT_FALSE(noticed_after_s({holds, from, -60.0}, from, holds, panning)) << holds;
    }
  }
}

TEST(GimbalYawWatch, ConcludesNothingOnAStraightFlight) {
  GimbalYawWatch watch;
  for (double time_s = 0.0; time_s < 300.0; time_s += 0.1)
    watch.observe({VehicleTime{from_seconds(time_s)}, ned_from_body({0.0, -1.0, 0.02 * std::sin(time_s)}),
                   GimbalYaw::kFromNorth, false},
                  1.5 + 0.04 * std::sin(0.3 * time_s));
  EXPECT_FALSE(watch.is_told_wrong());
}

TEST(GimbalYawWatch, ChangesItsMindWhereTheFlagsAreMended) {
  GimbalYawWatch watch;
  for (double time_s = 0.0; time_s < 240.0; time_s += 0.1) {
    const double vehicle_rad = surveying_yaw_rad(time_s);
    const GimbalYaw told = time_s < 60.0 ? GimbalYaw::kFromNose : GimbalYaw::kFromNorth;
    watch.observe({VehicleTime{from_seconds(time_s)}, ned_from_body({0.0, -1.0, vehicle_rad}), told, false},
                  vehicle_rad);
    if (std::abs(time_s - 55.0) < 0.05) {
      EXPECT_TRUE(watch.is_told_wrong());
    }
  }
  EXPECT_FALSE(watch.is_told_wrong());
}

}  // namespace
}  // namespace geoloc
