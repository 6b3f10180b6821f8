// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/set_point_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

using Motion = std::function<EulerAngles(double time_s)>;

EulerAngles in_gusts(double time_s) {
  return {0.05 * std::sin(2.0 * time_s), 0.04 * std::sin(1.4 * time_s), 0.0};
}
EulerAngles on_the_ground(double) {
  return {};
}
EulerAngles looking_down(double time_s) {
  return {0.0, -90.0 * kRadPerDeg, 0.3 * std::sin(time_s)};  // yaw may follow a vehicle's
}
EulerAngles sweeping(double time_s) {
  return {0.0, (-65.0 + 25.0 * std::sin(2.0 * kPi * time_s / 12.0)) * kRadPerDeg, 0.0};
}

/// Angles as a message has them, in single precision.
bool is_set_point(const Motion& gimbal, const Motion& vehicle, double noise_deg, double until_s = 60.0) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, noise_deg > 0.0 ? noise_deg * kRadPerDeg : 1.0);
  SetPointWatch watch;
  for (double time_s = 0.0; time_s < until_s; time_s += 0.1) {
    watch.note_vehicle(vehicle(time_s));
    Eigen::Quaterniond attitude = ned_from_body(gimbal(time_s));
    if (noise_deg > 0.0) attitude = attitude * ned_from_body({noise(random), noise(random), noise(random)});
    watch.observe(attitude.cast<float>().cast<double>().normalized());
  }
  return watch.is_set_point();
}

TEST(SetPointWatch, KnowsAnglesThatGoEvenlyWhileTheVehicleShakes) {
  for (const Motion& gimbal : {Motion(looking_down), Motion(sweeping)}) {
    EXPECT_TRUE(is_set_point(gimbal, in_gusts, 0.0));
    EXPECT_FALSE(is_set_point(gimbal, in_gusts, 0.0, 9.0)) << "ten seconds are looked at";
  }
}

TEST(SetPointWatch, KnowsMeasurementsByTheirNoise) {
  for (const double noise_deg : {0.02, 0.05, 0.3}) {
    EXPECT_FALSE(is_set_point(looking_down, in_gusts, noise_deg)) << noise_deg;
    EXPECT_FALSE(is_set_point(sweeping, in_gusts, noise_deg)) << noise_deg;
  }
}

TEST(SetPointWatch, ConcludesNothingWhileNothingMoves) {
  EXPECT_FALSE(is_set_point(looking_down, on_the_ground, 0.0));
}

TEST(SetPointWatch, TakesItBackWhereAnglesGetNoisy) {
  SetPointWatch watch;
  for (int i = 0; i < 400; ++i) {
    const double time_s = 0.1 * i;
    watch.note_vehicle(in_gusts(time_s));
    const double noise_rad = i < 200 ? 0.0 : 1e-3 * std::sin(10.0 * i * i);
    watch.observe(ned_from_body({noise_rad, -1.2, 0.0}));
    if (i == 199) {
      EXPECT_TRUE(watch.is_set_point());
    }
  }
  EXPECT_FALSE(watch.is_set_point());
}

TEST(SetPointWatch, KeepsWhatItFoundOverARestart) {
  SetPointWatch watch;
  for (int i = 0; i < 150; ++i) {
    watch.note_vehicle(in_gusts(0.1 * i));
    watch.observe(ned_from_body(looking_down(0.1 * i)));
  }
  ASSERT_TRUE(watch.is_set_point());
  watch.restart();
  EXPECT_TRUE(watch.is_set_point());
}

}  // namespace
}  // namespace geoloc
