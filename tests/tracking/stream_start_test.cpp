// SPDX-License-Identifier: Apache-2.0
#include "tracking/stream_start.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

constexpr double kOwnSigma_s = 0.01;

HostTime arrived_at(double time_s) {
  return HostTime{from_seconds(1000.0 + time_s)};
}

RunTimeError unstated(StreamStart& start, double time_s) {
  return start.observe(arrived_at(time_s), 0.0, kOwnSigma_s);
}

TEST(StreamStart, TheFirstSecondsShareAWideErrorAndLaterFramesNone) {
  StreamStart start;
  for (int i = 0; i < 100; ++i) {
    const RunTimeError error = unstated(start, 0.1 * i);
    EXPECT_EQ(error.sigma_s > 0.0, i < 30) << i;
    EXPECT_NEAR(error.frames, i < 30 ? 30.0 : 1.0, 1.0);
  }
}

TEST(StreamStart, AStreamThatPausedBeginsAnew) {
  StreamStart start;
  for (int i = 0; i < 100; ++i) unstated(start, 0.1 * i);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(unstated(start, 18.0 + 0.1 * i).sigma_s > 0.0, i < 30) << i;
}

TEST(StreamStart, FramesThatAlwaysComeSecondsApartAreNoStream) {
  StreamStart start;
  for (int i = 0; i < 100; ++i) {
    const double sigma_s = unstated(start, 4.0 * i).sigma_s;
    EXPECT_TRUE(i <= 8 || sigma_s == 0.0) << i;
  }
}

TEST(StreamStart, WhatIsStatedHoldsLessTheFramesOwnNoise) {
  StreamStart start;
  EXPECT_NEAR(start.observe(arrived_at(0.0), 0.3, kOwnSigma_s).sigma_s, 0.3, 1e-3);
  EXPECT_EQ(start.observe(arrived_at(0.1), kOwnSigma_s, kOwnSigma_s).sigma_s, 0.0);
  EXPECT_NEAR(start.observe(arrived_at(99.0), 0.05, 0.04).sigma_s, 0.03, 1e-9);
}

}  // namespace
}  // namespace geoloc
