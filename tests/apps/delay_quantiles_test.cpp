// SPDX-License-Identifier: Apache-2.0
#include "app/delay_quantiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace geoloc::apps {
namespace {

TEST(DelayQuantiles, AreThoseOfTheSortedDelaysToOnePercent) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> delays_ms(std::log(80.0), 1.5);
  DelayQuantiles quantiles;
  std::vector<double> sorted_ms;
  for (int i = 0; i < 10'000; ++i) {
    sorted_ms.push_back(delays_ms(random));
    quantiles.add(from_seconds(1e-3 * sorted_ms.back()));
  }
  std::sort(sorted_ms.begin(), sorted_ms.end());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const double exact_ms = sorted_ms[static_cast<std::size_t>(share * 10'000.0) - 1];
    EXPECT_NEAR(quantiles.ms(share) / exact_ms, 1.0, 0.011) << share;
  }
}

TEST(DelayQuantiles, TakeDelaysThatCannotBe) {
  DelayQuantiles quantiles;
  EXPECT_EQ(quantiles.ms(0.5), 0.0);
  quantiles.add(Duration{-1});
  quantiles.add(std::chrono::hours{1});
  EXPECT_EQ(quantiles.count(), 2U);
  EXPECT_LT(quantiles.ms(0.5), 0.2);
  EXPECT_GT(quantiles.ms(1.0), 99e3);
}

}  // namespace
}  // namespace geoloc::apps
