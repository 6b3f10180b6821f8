// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/height_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace geoloc {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Two rows and three columns, a hundredth of a degree apart.
HeightGrid::Layout small_layout() {
  return {46.0, 7.0, 0.01, 0.01, 2, 3};
}

TEST(HeightGrids, AreBilinearBetweenTheirNodes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> height_m(-50.0F, 400.0F);
  const HeightGrid::Layout layout{46.0, 7.0, 0.001, 0.002, 20, 30};
  std::vector<float> heights_m(20 * 30);
  for (float& h : heights_m) h = height_m(random);
  const HeightGrid grid(layout, heights_m);
  std::uniform_real_distribution<double> row(0.0, 19.0), column(0.0, 29.0);
  for (int i = 0; i < 1000; ++i) {
    const double r = row(random), c = column(random);
    // The sum over all nodes of what each weighs: the product of two triangles.
    double expected = 0.0;
    for (std::size_t j = 0; j < 20; ++j) {
      for (std::size_t k = 0; k < 30; ++k) {
        const double along = std::max(0.0, 1.0 - std::abs(r - static_cast<double>(j)));
        const double across = std::max(0.0, 1.0 - std::abs(c - static_cast<double>(k)));
        expected += along * across * heights_m[30 * j + k];
      }
    }
    const auto here = grid.at({46.0 + 0.001 * r, 7.0 + 0.002 * c});
    ASSERT_TRUE(here);
    EXPECT_NEAR(here->height_m, expected, 1e-6);
    EXPECT_LT(here->beyond_m, 1e-6);
  }
}

TEST(HeightGrids, GoOnAsTheirEdgeAndSayHowFarThatIs) {
  const HeightGrid grid(small_layout(), {1, 2, 3, 4, 5, 6});
  const auto north = grid.at({46.02, 7.01});
  ASSERT_TRUE(north);
  EXPECT_NEAR(north->height_m, 5.0, 1e-9);
  EXPECT_NEAR(north->beyond_m, 1112.0, 5.0);
  const auto corner = grid.at({45.99, 6.99});
  ASSERT_TRUE(corner);
  EXPECT_DOUBLE_EQ(corner->height_m, 1.0);
  EXPECT_NEAR(corner->beyond_m, std::hypot(1112.0, 1112.0 * std::cos(45.99 * 0.017453)), 10.0);
}

TEST(HeightGrids, HaveNoHeightBesideANodeThatHasNone) {
  const HeightGrid grid(small_layout(), {1, 2, 3, 4, kNaN, 6});
  EXPECT_FALSE(grid.at({46.001, 7.001}));
  EXPECT_FALSE(grid.at({std::nan(""), 7.0}));
  EXPECT_EQ(grid.least_m(), 1.0);
  EXPECT_EQ(grid.greatest_m(), 6.0);
}

TEST(HeightGrids, MeetThemselvesAtTheDateLine) {
  const HeightGrid grid({10.0, 179.99, 0.01, 0.01, 2, 3}, {1, 2, 3, 1, 2, 3});
  EXPECT_NEAR(grid.at({10.005, 180.0})->height_m, 2.0, 1e-6);
  EXPECT_NEAR(grid.at({10.005, -180.0})->height_m, 2.0, 1e-6);
  EXPECT_NEAR(grid.at({10.005, -179.99})->height_m, 3.0, 1e-6);
}

TEST(HeightGrids, ThatAreNoneAreRefused) {
  const std::vector<float> six{1, 2, 3, 4, 5, 6};
  const auto refuses = [](const HeightGrid::Layout& layout, const std::vector<float>& heights_m) {
    try {
      const HeightGrid grid(layout, heights_m);
      return false;
    } catch (const std::invalid_argument&) {
      return true;
    }
  };
  EXPECT_FALSE(refuses(small_layout(), six));
  EXPECT_TRUE(refuses(small_layout(), {1, 2, 3, 4, 5}));
  EXPECT_TRUE(refuses(small_layout(), {1, 2, 3, 4, 5, std::numeric_limits<float>::infinity()}));
  EXPECT_TRUE(refuses(small_layout(), std::vector<float>(6, kNaN)));
  EXPECT_TRUE(refuses({46.0, 7.0, 0.01, 0.01, 1, 6}, six));
  EXPECT_TRUE(refuses({46.0, 7.0, -0.01, 0.01, 2, 3}, six));
  EXPECT_TRUE(refuses({46.0, 7.0, std::nan(""), 0.01, 2, 3}, six));
  EXPECT_TRUE(refuses({89.995, 7.0, 0.01, 0.01, 2, 3}, six));
  EXPECT_TRUE(refuses({46.0, 7.0, 0.01, 200.0, 2, 3}, six));
}

}  // namespace
}  // namespace geoloc
