// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/projector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "projection/regimes.hpp"

namespace geoloc {
namespace {

class ProjectorLaws : public ::testing::TestWithParam<Regime> {};

TEST_P(ProjectorLaws, ReprojectIsTheInverse) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  int fixes = 0;
  for (double v = 10; v < 720; v += 50) {
    const auto fix = projector.project({700.0, v}, enu_from_camera);
    if (!fix) continue;
    ++fixes;
    const auto pixel = projector.reproject(fix->position_in_enu, enu_from_camera);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(700.0, v)).norm(), 1e-6);
  }
  EXPECT_GE(fixes, 9);
}

TEST_P(ProjectorLaws, ReprojectsAGroundPointAsThePointOfThatHeight) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  const auto fix = projector.project({700.0, 600.0}, enu_from_camera);
  ASSERT_TRUE(fix);
  const Eigen::Vector3d point(fix->position_in_enu.x(), fix->position_in_enu.y(), 1.5);
  EXPECT_EQ(*projector.reproject(point, enu_from_camera),
            *projector.reproject(fix->position_in_enu, enu_from_camera));
}

/// All points of a ray appear at one pixel.
TEST_P(ProjectorLaws, ReprojectsEveryPointOfARayToItsPixel) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  const Eigen::Vector2d pixel(500.0, 650.0);
  const auto fix = projector.project(pixel, enu_from_camera);
  ASSERT_TRUE(fix);
  for (const double share : {0.3, 0.8, 1.0, 1.2}) {
    const Eigen::Vector3d point = enu_from_camera.translation + share * fix->range_m * fix->direction_in_enu;
    const auto shown = projector.reproject(point, enu_from_camera);
    ASSERT_TRUE(shown);
    EXPECT_LT((*shown - pixel).norm(), 1e-6) << share;
  }
}

/// As if its pixel's ray met a plane of the point's height.
TEST_P(ProjectorLaws, FixOfAPointIsThatOfItsPixelOnTheLevelOfItsHeight) {
  const Rigid3d enu_from_camera = pose_of(GetParam());
  const Projector projector(ground_at_1_5_m(), kCamera);
  for (const double height_m : {1.5, -4.0, 6.5}) {
    ProjectorConfig at_height = ground_at_1_5_m();
    at_height.ground_height_above_home_m = height_m;
    const auto expected = Projector(at_height, kCamera).project({500.0, 650.0}, enu_from_camera);
    ASSERT_TRUE(expected);
    const Eigen::Vector3d point(expected->position_in_enu.x(), expected->position_in_enu.y(), height_m);
    const auto fix = projector.fix_of_point(point, enu_from_camera);
    ASSERT_TRUE(fix);
    EXPECT_LT((fix->position_in_enu - expected->position_in_enu).norm(), 1e-9);
    EXPECT_LT((fix->ground_from_pixel - expected->ground_from_pixel).norm(), 1e-9);
    EXPECT_LT((fix->direction_in_enu - expected->direction_in_enu).norm(), 1e-12);
    EXPECT_NEAR(fix->range_m, expected->range_m, 1e-9);
  }
}

TEST_P(ProjectorLaws, StatedCovarianceIsTheSampledOne) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  const Eigen::Vector2d pixel{500.0, 650.0};
  const double sigma_px = 0.5;
  const auto fix = projector.project(pixel, enu_from_camera);
  ASSERT_TRUE(fix);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, sigma_px);
  Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const auto moved =
        projector.project(pixel + Eigen::Vector2d(noise(random), noise(random)), enu_from_camera);
    ASSERT_TRUE(moved);
    const Eigen::Vector2d error = moved->position_in_enu - fix->position_in_enu;
    sampled += error * error.transpose() / kSamples;
  }
  const Eigen::Matrix2d stated = fix->covariance(sigma_px);
  EXPECT_LT((sampled - stated).norm(), 0.05 * stated.norm());
}

TEST_P(ProjectorLaws, BatchIsTheSingleCallRepeated) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  std::vector<Eigen::Vector2d> pixels;
  for (double v = -100; v < 800; v += 37) pixels.emplace_back(1.3 * v, v);
  pixels.insert(pixels.end(), {{std::nan(""), 3.0}, {3.0, INFINITY}, {1e4, -1e4}, {-1e300, 0.0}});
  std::vector<Expected<GroundFix, NoFix>> fixes;
  projector.project(pixels, enu_from_camera, fixes);
  ASSERT_EQ(fixes.size(), pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto single = projector.project(pixels[i], enu_from_camera);
    ASSERT_EQ(fixes[i].has_value(), single.has_value());
    if (!single) {
      EXPECT_EQ(fixes[i].error(), single.error()) << pixels[i].transpose();
      continue;
    }
    EXPECT_EQ(fixes[i]->position_in_enu, single->position_in_enu);
    EXPECT_EQ(fixes[i]->ground_from_pixel, single->ground_from_pixel);
    EXPECT_EQ(fixes[i]->direction_in_enu, single->direction_in_enu);
    EXPECT_EQ(fixes[i]->range_m, single->range_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, ProjectorLaws, every_regime(), regime_name);

TEST(Projector, TellsWhyThereIsNoFix) {
  ProjectorConfig config;
  config.max_range_m = 100.0;
  const Projector projector(config, CameraIntrinsics{});
  const Eigen::Vector2d centre{639.5, 359.5};
  const auto reason = [&](double height_m, double pitch_deg) {
    return projector.project(centre, pose_of({"", height_m, pitch_deg, 0, 0})).error();
  };
  EXPECT_EQ(reason(20, 10), NoFix::kAboveHorizon);
  EXPECT_EQ(reason(5, -4), NoFix::kTooGrazing);
  EXPECT_EQ(reason(50, -20), NoFix::kTooFar);
  EXPECT_EQ(reason(-1, -90), NoFix::kBelowGround);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(projector.project({nan, 0}, pose_of({"", 20, -90, 0, 0})).error(), NoFix::kNotFinite);
  EXPECT_EQ(reason(nan, -90), NoFix::kNotFinite);
  const Projector folded(config, {1280, 720, 914, 914, 639.5, 359.5, {-0.24, 0, 0, 0, 0}});
  EXPECT_EQ(folded.project({5000.0, 360.0}, pose_of({"", 20, -90, 0, 0})).error(), NoFix::kNoRay);
  EXPECT_FALSE(projector.reproject(Eigen::Vector2d(0.0, 0.0), pose_of({"", 20, 80, 0, 0})));  // behind
}

/// Straight down from 20 m.
/// A point's own ray tells as much as its pixel does.
TEST_P(ProjectorLaws, TellsOfAPointWhatItTellsOfItsPixel) {
  const Rigid3d enu_from_camera = pose_of(GetParam());
  ProjectorConfig config = ground_at_1_5_m();
  config.max_range_m = 150.0;
  config.min_depression_deg = 12.0;
  const Projector projector(config, kCamera);
  int fixes = 0, none = 0;
  for (double east_m = -400.0; east_m <= 400.0; east_m += 31.0) {
    for (double north_m = -400.0; north_m <= 400.0; north_m += 31.0) {
      const Eigen::Vector3d point = enu_from_camera.translation + Eigen::Vector3d(east_m, north_m, -50.0);
      const auto pixel = projector.reproject(point, enu_from_camera);
      const auto fix = projector.fix_of_point(point, enu_from_camera);
      ASSERT_TRUE(pixel || !fix);
      if (!pixel || !projector.camera().ray(*pixel)) continue;  // far outside, the lens has no inverse
      const auto expected = projector.project(*pixel, enu_from_camera);
      ASSERT_EQ(fix.has_value(), expected.has_value()) << point.transpose();
      EXPECT_EQ(projector.sees_point(point, enu_from_camera, 0.0),
                expected && projector.camera().contains(*pixel));
      ++(fix ? fixes : none);
    }
  }
  EXPECT_GT(fixes, 0);
  EXPECT_GT(none, 0);
}

TEST(Projector, ReachesAsFarAsItsRangeAndNoFarther) {
  const CameraIntrinsics straight;
  const Rigid3d looking_down{Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 20.0}};
  const auto has_fix = [&](double max_range_m) {
    ProjectorConfig config;
    config.max_range_m = max_range_m;
    return Projector(config, straight).project({straight.cx_px, straight.cy_px}, looking_down).has_value();
  };
  EXPECT_TRUE(has_fix(20.0));
  EXPECT_FALSE(has_fix(std::nextafter(20.0, 0.0)));
}

TEST(Projector, SeesWhatIsInTheImageAwayFromItsEdge) {
  const Projector projector({}, CameraIntrinsics{});
  const Rigid3d down = pose_of({"", 20, -90, 0, 0});
  EXPECT_TRUE(projector.sees(down.translation.head<2>(), down, 40.0));
  EXPECT_FALSE(projector.sees({down.translation.x() + 13.6, down.translation.y()}, down, 40.0));
  EXPECT_TRUE(projector.sees({down.translation.x() + 13.6, down.translation.y()}, down, 0.0));
  EXPECT_FALSE(projector.sees({1000.0, 1000.0}, down, 0.0));
}

}  // namespace
}  // namespace geoloc
