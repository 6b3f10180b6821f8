// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace geoloc {
namespace {

VehicleTime frame_time(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

TEST(NoiseClock, CountsTheFramesOfTwoTimeConstants) {
  NoiseClock clock(1.0, 0.6);
  EXPECT_EQ(clock.tick(frame_time(5.0)).of_position, 1.0);  // no rate is known yet
  const NoiseRepetition ten_per_second = clock.tick(frame_time(5.1));
  EXPECT_NEAR(ten_per_second.of_position, 20.0, 1e-9);
  EXPECT_NEAR(ten_per_second.of_attitude, 12.0, 1e-9);
  const NoiseRepetition rare = clock.tick(frame_time(8.1));
  EXPECT_EQ(rare.of_position, 1.0);
  EXPECT_EQ(rare.of_attitude, 1.0);
}

TEST(NoiseClock, CountsTheFramesThatWereInterpolatedBetweenTheSameSamples) {
  NoiseClock clock(1.0, 0.6);
  EXPECT_EQ(clock.tick(frame_time(5.0), from_seconds(1.0)).of_interpolation, 1.0);
  EXPECT_NEAR(clock.tick(frame_time(5.1), from_seconds(1.0)).of_interpolation, 10.0, 1e-9);
  EXPECT_NEAR(clock.tick(frame_time(5.2), from_seconds(0.5)).of_interpolation, 5.0, 1e-9);
  EXPECT_EQ(clock.tick(frame_time(5.3), from_seconds(0.02)).of_interpolation, 1.0);
}

TEST(NoiseClock, KeepsItsRateWhereTimeStandsStillOrRunsBack) {
  NoiseClock clock(1.0, 0.6);
  clock.tick(frame_time(5.0));
  clock.tick(frame_time(5.1));
  EXPECT_NEAR(clock.tick(frame_time(5.1)).of_position, 20.0, 1e-9);
  EXPECT_NEAR(clock.tick(frame_time(1.0)).of_attitude, 12.0, 1e-9);
  EXPECT_NEAR(clock.tick(frame_time(1.2)).of_position, 10.0, 1e-9);
}

/// Of exponentially correlated noise, the mean over many frames varies by so much more than of independent
/// noise: by simulation.
TEST(NoiseClock, SaysByHowMuchAMeanOverManyFramesIsLessCertain) {
  constexpr double kConstant_s = 1.0, kPause_s = 0.2;
  constexpr int kFrames = 400, kRuns = 3000;
  NoiseClock clock(kConstant_s, kConstant_s);
  clock.tick(frame_time(0.0));
  const double repetition = clock.tick(frame_time(kPause_s)).of_position;
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  const double kept = std::exp(-kPause_s / kConstant_s);
  double sum_of_squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    double noise = normal(random), sum = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
      sum += noise;
      noise = kept * noise + std::sqrt(1.0 - kept * kept) * normal(random);
    }
    sum_of_squares += sum * sum / kFrames;
  }
  EXPECT_NEAR(sum_of_squares / kRuns, repetition, 0.1 * repetition);
}

TEST(FrameNoise, LeavesATrackAsItWasSeenForLongerThanItLasts) {
  const FrameNoise noise{Eigen::Matrix2d::Identity(), 20.0, 1.0};
  EXPECT_EQ(noise.share_in_track(1), 1.0);
  EXPECT_EQ(noise.share_in_track(20), 1.0);
  EXPECT_EQ(noise.share_in_track(40), 0.5);
}

TEST(FrameNoise, IsSharedByMomentsThatAreNear) {
  const FrameNoise noise{Eigen::Matrix2d::Identity(), 20.0, 2.0};
  EXPECT_EQ(noise.common_share(Duration{0}), 1.0);
  EXPECT_NEAR(noise.common_share(from_seconds(2.0)), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(noise.common_share(from_seconds(-3.0)), std::exp(-1.5), 1e-12);
  const FrameNoise white{Eigen::Matrix2d::Identity(), 1.0, 0.0};
  EXPECT_EQ(white.common_share(Duration{0}), 1.0);
  EXPECT_LT(white.common_share(from_seconds(0.1)), 1e-12);
}

TEST(FrameShift, LeadsFromAPlaceToWhereTheFrameShowsItAndBack) {
  const FrameShift shift{{0.5, -0.25}, {0.125, 1.0}, {2.0, 4.0}, -3.0};
  const Eigen::Vector2d shown = shift.shown(Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(shown, Eigen::Vector2d(10.0 - 0.5 - 0.125 + 2.0, 20.0 + 0.25 - 1.0 + 4.0));
  EXPECT_EQ(Eigen::Vector2d(shown + shift.correction()), Eigen::Vector2d(10.0, 20.0));
  // Heights are above the level ground, which has its own height in the frame's view.
  EXPECT_EQ(shift.shown(Eigen::Vector3d(10.0, 20.0, 1.5)), Eigen::Vector3d(shown.x(), shown.y(), -1.5));
}

}  // namespace
}  // namespace geoloc
