// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/circular_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace geoloc::io {
namespace {

TEST(CircularError, IsRayleighsForACircle) {
  for (const double p : {0.3934693, 0.5, 0.9, 0.95}) {
    EXPECT_NEAR(circular_error(2.0, 2.0, p), 2.0 * std::sqrt(-2.0 * std::log(1.0 - p)), 1e-4);
  }
}

TEST(CircularError, IsTheNormalDistributionsForALine) {
  // scipy.stats.norm.ppf((1 + p) / 2)
  EXPECT_NEAR(circular_error(3.0, 0.0, 0.9), 3.0 * 1.644854, 1e-4);
  EXPECT_NEAR(circular_error(1.0, 0.0, 0.6826895), 1.0, 1e-4);
}

TEST(CircularError, HoldsThatShareOfSamples) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (const double minor : {0.01, 0.1, 0.5, 0.9}) {
    const double radius = circular_error(minor, 1.0, 0.9);  // whichever axis comes first
    constexpr int kSamples = 200'000;
    int within = 0;
    for (int i = 0; i < kSamples; ++i)
      within += std::hypot(normal(generator), minor * normal(generator)) < radius ? 1 : 0;
    EXPECT_NEAR(within / double{kSamples}, 0.9, 0.003) << minor;
  }
}

TEST(CircularError, OfNonsenseIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(circular_error(nan, 1.0, 0.9)));
  EXPECT_TRUE(std::isnan(circular_error(1.0, -1.0, 0.9)));
  EXPECT_TRUE(std::isnan(circular_error(std::numeric_limits<double>::infinity(), 1.0, 0.9)));
  EXPECT_TRUE(std::isnan(circular_error(1.0, 1.0, 1.0)));
  EXPECT_EQ(circular_error(0.0, 0.0, 0.9), 0.0);
}

}  // namespace
}  // namespace geoloc::io
