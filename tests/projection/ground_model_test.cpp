// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/ground_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "projection/regimes.hpp"
#include "support/tilted_ground.hpp"

namespace geoloc {
namespace {

using testing::grid_of;
using testing::tilted_ground;

const LocalFrame kFrame({46.05, 7.03});
const Eigen::Vector2d kSlope(0.3, -0.2);
constexpr double kSigma_m = 2.0;

/// Waves of 120 m, 8 m high.
double waves_m(const Eigen::Vector2d& place) {
  return 8.0 * std::sin(place.x() / 19.0) * std::cos(place.y() / 19.0);
}

TEST(Ground, ThatIsLevelHasNoHeightAndNoSlope) {
  const GroundModel ground(kSigma_m);
  EXPECT_TRUE(ground.is_level());
  const GroundAt here = ground.at({30.0, -70.0});
  EXPECT_EQ(here.height_m, 0.0);
  EXPECT_EQ(here.slope, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(here.sigma_m, kSigma_m);
}

/// Whatever datum the grid's heights have.
TEST(Ground, CountsFromTheOrigin) {
  const GroundModel ground(tilted_ground(kFrame, kSlope), kFrame, kSigma_m);
  EXPECT_NEAR(ground.at({0.0, 0.0}).height_m, 0.0, 1e-4);
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(50.0, 20.0), Eigen::Vector2d(-90.0, 130.0)}) {
    const GroundAt here = ground.at(place);
    EXPECT_NEAR(here.height_m, kSlope.dot(place), 1e-3);  // the grid's meridians meet at the pole
    EXPECT_LT((here.slope - kSlope).norm(), 1e-3);
    EXPECT_EQ(here.sigma_m, kSigma_m);
  }
}

TEST(Ground, IsLessSureBeyondTheGridAndInAHole) {
  const GroundModel ground(tilted_ground(kFrame, kSlope), kFrame, kSigma_m);
  EXPECT_NEAR(ground.at({300.0, 0.0}).height_m, 60.0, 0.1);
  EXPECT_NEAR(ground.at({220.0, 0.0}).sigma_m, std::hypot(kSigma_m, 0.2 * 20.0), 0.1);
  EXPECT_NEAR(ground.at({9000.0, 0.0}).sigma_m, std::hypot(kSigma_m, 10.0), 1e-9);
  const auto hole = [](const Eigen::Vector2d& place) { return place.x() > 50.0 ? std::nan("") : 700.0; };
  const GroundModel with_hole(grid_of(kFrame, hole), kFrame, kSigma_m);
  EXPECT_EQ(with_hole.at({0.0, 0.0}).sigma_m, kSigma_m);
  EXPECT_EQ(with_hole.at({60.0, 0.0}).sigma_m, 10.0);
  EXPECT_EQ(with_hole.at({60.0, 0.0}).height_m, 0.0);
}

// --- Rays.

/// n.(o + t v) = n.p for the plane with the normal (-slope, 1).
TEST(Rays, MeetATiltedPlaneWhereTheClosedFormSays) {
  const GroundModel ground(tilted_ground(kFrame, kSlope), kFrame, kSigma_m);
  const Eigen::Vector3d normal(-kSlope.x(), -kSlope.y(), 1.0);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> across(-1.0, 1.0), place_m(-40.0, 40.0);
  for (int i = 0; i < 200; ++i) {
    const Ray<double> ray{{place_m(random), place_m(random), 60.0},
                          Eigen::Vector3d(across(random), across(random), -1.0).normalized()};
    const auto range_m = intersect(ray, ground, 1000.0);
    ASSERT_TRUE(range_m);
    EXPECT_NEAR(*range_m, -normal.dot(ray.origin) / normal.dot(ray.direction), 1e-2);
  }
}

TEST(Rays, MeetLevelGroundAsAPlane) {
  const GroundModel ground(kSigma_m);
  const Ray<double> ray{{1.0, 2.0, 30.0}, Eigen::Vector3d(0.3, -0.4, -1.2).normalized()};
  EXPECT_NEAR(*intersect(ray, ground, 1000.0), 30.0 * 1.3 / 1.2, 1e-9);
  EXPECT_FALSE(intersect(ray, ground, 32.0));
}

/// What a walk in millimetres finds.
TEST(Rays, MeetTheFirstHillOnTheirWay) {
  const GroundModel ground(grid_of(kFrame, waves_m), kFrame, kSigma_m);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> direction(-3.1, 3.1), fall(0.1, 1.5);
  for (int i = 0; i < 40; ++i) {
    const double turn = direction(random);
    const Ray<double> ray{{5.0, -3.0, 15.0},
                          Eigen::Vector3d(std::cos(turn), std::sin(turn), -fall(random)).normalized()};
    double walked_m = 0.0;
    while (ray.at(walked_m).z() > ground.height_m(ray.at(walked_m).head<2>())) walked_m += 2e-3;
    const auto range_m = intersect(ray, ground, 1000.0);
    ASSERT_TRUE(range_m);
    EXPECT_NEAR(*range_m, walked_m, 3e-3) << turn;
  }
}

TEST(Rays, ThatRiseOrBeginBelowTheGroundOrAreNotFiniteMeetNothing) {
  const GroundModel ground(grid_of(kFrame, waves_m), kFrame, kSigma_m);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 20}, {1, 0, 0}}, ground, 1000.0));
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, -20}, down}, ground, 1000.0));
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 1e4}, down}, ground, 1000.0));
  EXPECT_FALSE(intersect(Ray<double>{{std::nan(""), 0, 20}, down}, ground, 1000.0));
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 20}, {0, 0, std::nan("")}}, ground, 1000.0));
}

// --- The paper's method projects onto it.

class ProjectionOntoGround : public ::testing::TestWithParam<Regime> {};

TEST_P(ProjectionOntoGround, EndsWhereTheGroundIsSeenAtThePixel) {
  const GroundModel ground(grid_of(kFrame, waves_m), kFrame, kSigma_m);
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d pose = pose_of(GetParam());
  const Eigen::Vector2d pixel(700.0, 600.0);
  const auto fix = projector.project(pixel, pose, ground);
  ASSERT_TRUE(fix);
  const Eigen::Vector2d& place = fix->position_in_enu;
  const Eigen::Vector3d point(place.x(), place.y(), 1.5 + ground.height_m(place));
  const auto shown = projector.reproject(point, pose);
  ASSERT_TRUE(shown);
  EXPECT_LT((*shown - pixel).norm(), 1e-3);
  EXPECT_TRUE(projector.sees(place, pose, 0.0, ground));
}

/// On a plane, where it is exact.
TEST_P(ProjectionOntoGround, MovesByThePixelAsDifferencesSay) {
  const GroundModel ground(tilted_ground(kFrame, {0.1, 0.05}), kFrame, kSigma_m);
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d pose = pose_of(GetParam());
  const Eigen::Vector2d pixel(640.0, 400.0);
  const auto fix = projector.project(pixel, pose, ground);
  ASSERT_TRUE(fix);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = 0.5 * Eigen::Vector2d::Unit(axis);
    const auto more = projector.project(pixel + step, pose, ground);
    const auto less = projector.project(pixel - step, pose, ground);
    ASSERT_TRUE(more && less);
    const Eigen::Vector2d difference = more->position_in_enu - less->position_in_enu;
    EXPECT_LT((fix->ground_from_pixel.col(axis) - difference).norm(), 1e-3 * difference.norm() + 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, ProjectionOntoGround,
                         ::testing::Values(Regime{"nadir", 30, -90, 0, 30},
                                           Regime{"banked", 30, -90, 25, 200},
                                           Regime{"oblique", 60, -45, -10, 300}),
                         regime_name);

}  // namespace
}  // namespace geoloc
