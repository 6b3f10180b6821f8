// SPDX-License-Identifier: Apache-2.0
#include "tracking/ground_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/tilted_ground.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

const LocalFrame kFrame({46.05, 7.03});
const Eigen::Vector2d kSlope(0.4, -0.1);
constexpr double kSigma_m = 1.5;

GroundModel hillside() {
  return GroundModel(testing::tilted_ground(kFrame, kSlope), kFrame, kSigma_m);
}

/// From 20 m above level ground.
Look look_along(const Eigen::Vector2d& place, const Eigen::Vector2d& slope) {
  Look look = testing::lone_look(place, 0.01, slope);
  look.camera_height_m = 20.0;
  return look;
}

/// (z - slope x)^2 / sigma^2.
TEST(GroundPrior, IsThePlaneThatTouchesTheGround) {
  const PointInformation prior = ground_prior(hillside(), {12.0, 7.0}, 0.0);
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(12.0, 7.0), Eigen::Vector2d(-30.0, 11.0)}) {
    for (const double up_m : {-3.0, 0.0, 2.0}) {
      const Point x(place.x(), place.y(), kSlope.dot(place) + up_m);
      const Point on_ground(place.x(), place.y(), kSlope.dot(place));
      const auto cost = [&](const Point& p) { return p.dot(prior.matrix * p) - 2.0 * prior.vector.dot(p); };
      EXPECT_NEAR(cost(x) - cost(on_ground), std::pow(up_m / kSigma_m, 2), 2e-2);
    }
  }
}

TEST(GroundPrior, OfLevelGroundSaysNothingOfThePlace) {
  const PointInformation prior = ground_prior(GroundModel(2.0), {12.0, 7.0}, 0.0);
  PointMatrix expected = PointMatrix::Zero();
  expected(2, 2) = 0.25;
  EXPECT_EQ(prior.matrix, expected);
  EXPECT_EQ(prior.vector, Point(0.0, 0.0, 0.0));
  EXPECT_EQ(ground_prior(GroundModel(2.0), {12.0, 7.0}, 4.0).matrix(2, 2), 1.0 / 16.0);
}

/// z = slope_ground . (p + s z), solved for z.
TEST(GroundPoint, IsWhereTheRayMeetsTheHillside) {
  const Eigen::Vector2d place(3.0, 5.0), slope(0.5, 0.3);
  const Point met = ground_point(look_along(place, slope), hillside(), 1000.0);
  const double z = kSlope.dot(place) / (1.0 - kSlope.dot(slope));
  EXPECT_NEAR(met.z(), z, 1e-2);
  EXPECT_LT((met.head<2>() - (place + slope * z)).norm(), 1e-2);
}

TEST(GroundPoint, OfARayThatMissesIsBelowTheLook) {
  Look look = look_along({3.0, 5.0}, {0.5, 0.3});
  EXPECT_EQ(ground_point(look, GroundModel(2.0), 1.0), Point(3.0, 5.0, 0.0));
}

/// The same ray and the same camera, whichever height the look is placed at: every point is shown alike
/// against it.
TEST(Looks, PlacedAtAnotherHeightShowTheSameResiduals) {
  const Look level = look_along({3.0, 5.0}, {0.5, 0.3});
  Look raised = level;
  place_at_height(raised, 6.0);
  EXPECT_LT((raised.position - Eigen::Vector2d(6.0, 6.8)).norm(), 1e-12);
  EXPECT_EQ(raised.camera_height_m, 14.0);
  const auto residual = [](const Look& look, const Point& point) {
    return Eigen::Vector2d(look.position - look.shown(point));
  };
  for (const double up_m : {0.0, 6.0, 8.0}) {
    const Eigen::Vector2d place = level.position + level.observation.slope * up_m;
    EXPECT_LT(residual(level, {place.x(), place.y(), up_m}).norm(), 1e-9);
    EXPECT_LT(residual(raised, {place.x(), place.y(), up_m}).norm(), 1e-9);
  }
}

TEST(Looks, AtWhatMovesStandOnTheGround) {
  std::vector<Look> looks{look_along({3.0, 5.0}, {0.5, 0.3}), look_along({-8.0, 1.0}, {0.0, 0.0})};
  const std::vector<Look> before = looks;
  place_on_ground(looks, hillside(), 1000.0);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_NEAR(looks[i].terrain_m, kSlope.dot(looks[i].position), 1e-2);
    const Eigen::Vector2d along = before[i].position + before[i].observation.slope * looks[i].terrain_m;
    EXPECT_LT((looks[i].position - along).norm(), 1e-9);
  }
  std::vector<Look> on_level = before;
  place_on_ground(on_level, GroundModel(2.0), 1000.0);
  EXPECT_EQ(on_level[0].position, before[0].position);
}

}  // namespace
}  // namespace geoloc
