// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace geoloc::sim {
namespace {

/// Distance of every point to its nearest neighbour [m], sorted.
std::vector<double> nearest_distances_m(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (i != j) nearest_m = std::min(nearest_m, (points[i] - points[j]).norm());
    }
    distances_m.push_back(nearest_m);
  }
  std::sort(distances_m.begin(), distances_m.end());
  return distances_m;
}

class Scenario : public ::testing::TestWithParam<int> {};

TEST_P(Scenario, HasThirtyTargetsInTheAreaForEverySeed) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto targets = make_scenario(GetParam(), seed);
    ASSERT_EQ(targets.size(), 30U);
    for (const Eigen::Vector2d& target : targets) {
      ASSERT_LE(std::abs(target.x()), kAreaHalfEast_m);
      ASSERT_LE(std::abs(target.y()), kAreaHalfNorth_m);
    }
    ASSERT_GE(nearest_distances_m(targets).front(), 1.2 - 1e-9);
  }
}

TEST_P(Scenario, DependsOnTheSeedAlone) {
  EXPECT_EQ(make_scenario(GetParam(), 7), make_scenario(GetParam(), 7));
  EXPECT_NE(make_scenario(GetParam(), 7), make_scenario(GetParam(), 8));
}

INSTANTIATE_TEST_SUITE_P(All, Scenario, ::testing::Values(1, 2, 3));

TEST(ScenarioShape, SpreadTargetsKeepTheirDistance) {
  EXPECT_GE(nearest_distances_m(make_scenario(1, 3)).front(), 6.0);
}

TEST(ScenarioShape, ClusteredTargetsAllHaveACloseNeighbourAndSixPairsAreClosest) {
  const auto distances_m = nearest_distances_m(make_scenario(2, 3));
  EXPECT_NEAR(distances_m[0], 1.2, 1e-9);
  EXPECT_NEAR(distances_m[11], 1.2, 1e-9);
  EXPECT_LE(distances_m.back(), 2.0 + 1e-9);
}

TEST(ScenarioShape, GridIsRegular) {
  const auto distances_m = nearest_distances_m(make_scenario(3, 3));
  EXPECT_NEAR(distances_m.front(), distances_m.back(), 1e-9);
  EXPECT_GT(distances_m.front(), 10.0);
}

TEST(ScenarioShape, OtherNumbersAreRefused) {
  EXPECT_THROW(make_scenario(0, 1), std::invalid_argument);
  EXPECT_THROW(make_scenario(4, 1), std::invalid_argument);
}

TEST(Pairs, StandAsFarApartAsAskedAndApartFromOthers) {
  for (const double distance_m : {0.3, 1.2, 3.0}) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const auto targets = make_pairs(distance_m, seed);
      ASSERT_EQ(targets.size(), 30U);
      const auto distances_m = nearest_distances_m(targets);
      ASSERT_NEAR(distances_m.front(), distance_m, 1e-9);
      ASSERT_NEAR(distances_m.back(), distance_m, 1e-9);
      for (const Eigen::Vector2d& target : targets) {
        ASSERT_LE(std::abs(target.x()), kAreaHalfEast_m);
        ASSERT_LE(std::abs(target.y()), kAreaHalfNorth_m);
      }
    }
  }
  EXPECT_THROW(make_pairs(0.0, 1), std::invalid_argument);
  EXPECT_THROW(make_pairs(std::nan(""), 1), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::sim
