// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geoloc::sim {
namespace {

TEST(Terrain, IsLevelWithoutHills) {
  const Terrain terrain{0.0, -7.5};
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, -20)})
    EXPECT_EQ(terrain.height_above_home_m(place), -7.5);
}

/// Its mean is the level, and its standard deviation 0.88 times the amplitude: over a square kilometre.
TEST(Terrain, WavesAboutItsLevel) {
  const Terrain terrain{2.0, 5.0};
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (double east = -500.0; east < 500.0; east += 2.5) {
    for (double north = -500.0; north < 500.0; north += 2.5) {
      const double height_m = terrain.height_above_home_m({east, north});
      sum += height_m;
      squares += height_m * height_m;
      ++count;
    }
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 5.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.88 * 2.0, 0.05);
}

TEST(Terrain, HasTargetsStandOnIt) {
  const Terrain terrain{1.5, 0.0};
  const auto targets = standing_on(terrain, {{10.0, -4.0}, {-33.0, 21.0}});
  ASSERT_EQ(targets.size(), 2U);
  for (const Eigen::Vector3d& target : targets)
    EXPECT_EQ(target.z(), terrain.height_above_home_m(target.head<2>()));
}

/// At the nodes to the millimetre, between them to what a wave bends.
TEST(Terrain, IsItsElevationModelAboveTheSea) {
  const Terrain terrain{1.5, 4.0};
  const LocalFrame frame({-22.906, -43.133}, 10.0);
  const HeightGrid model = elevation_model(terrain, frame, 2.0, 10.0);
  EXPECT_NEAR(model.spacing_m(), 2.0, 0.02);
  for (double east = -150.0; east < 150.0; east += 17.3) {
    for (double north = -150.0; north < 150.0; north += 13.1) {
      const auto here = model.at(frame.to_geodetic({east, north}));
      ASSERT_TRUE(here);
      EXPECT_NEAR(here->height_m, 10.0 + terrain.height_above_home_m({east, north}), 0.06);
    }
  }
}

TEST(Terrain, IsWrittenFromNorthToSouth) {
  const HeightGrid model({46.0, 7.0, 0.25, 0.5, 2, 3}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(to_ascii_grid(model),
            "ncols 3\nnrows 2\nxllcenter 7\nyllcenter 46\ndx 0.5\ndy 0.25\n"
            "4.000 5.000 6.000\n1.000 2.000 3.000\n");
}

TEST(Terrain, NamesItsFaults) {
  EXPECT_TRUE(Terrain{}.problems().empty());
  EXPECT_EQ((Terrain{-1.0, 1000.0}.problems().size()), 2U);
  EXPECT_EQ((Terrain{std::nan(""), std::nan("")}.problems().size()), 2U);
}

}  // namespace
}  // namespace geoloc::sim
