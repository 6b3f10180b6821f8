// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/projector.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"

namespace geoloc {
namespace {

const CameraIntrinsics kCamera{1280, 720, 914.0, 914.0, 639.5, 359.5, {-0.1, 0.03, 0.001, -0.001, 0.0}};

struct Regime {
  const char* name;
  double height_m;
  double pitch_deg;  ///< of the camera
  double roll_deg;
  double yaw_deg;
};

Rigid3d pose(const Regime& regime) {
  CameraMount mount;
  mount.pitch_deg = regime.pitch_deg;
  const EulerAngles vehicle{regime.roll_deg * kRadPerDeg, 0.02, regime.yaw_deg * kRadPerDeg};
  return Rigid3d{enu_from_ned() * ned_from_body(vehicle), {12.0, -7.0, regime.height_m}} *
         body_from_camera(mount);
}

class ProjectorLaws : public ::testing::TestWithParam<Regime> {
 protected:
  ProjectorConfig config() const {
    ProjectorConfig config;
    config.ground_height_above_home_m = 1.5;
    config.max_range_m = 5000.0;
    return config;
  }
};

TEST_P(ProjectorLaws, OpenCvProjectsTheFixBackToItsPixel) {
  const Projector projector(config(), kCamera);
  const Rigid3d enu_from_camera = pose(GetParam());
  cv::Matx33d camera_from_enu;
  cv::eigen2cv(Eigen::Matrix3d(enu_from_camera.rotation.conjugate().toRotationMatrix()), camera_from_enu);
  const Eigen::Vector3d t = enu_from_camera.inverse().translation;
  cv::Vec3d rotation_vector;
  cv::Rodrigues(camera_from_enu, rotation_vector);
  const cv::Matx33d matrix(kCamera.fx_px, 0, kCamera.cx_px, 0, kCamera.fy_px, kCamera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(kCamera.distortion.begin(), kCamera.distortion.end());
  int fixes = 0;
  for (double u = 0; u < 1280; u += 91) {
    for (double v = 0; v < 720; v += 67) {
      const auto fix = projector.project({u, v}, enu_from_camera);
      if (!fix) continue;
      ++fixes;
      const std::vector<cv::Point3d> ground{{fix->position_in_enu.x(), fix->position_in_enu.y(), 1.5}};
      std::vector<cv::Point2d> pixel;
      cv::projectPoints(ground, rotation_vector, cv::Vec3d(t.x(), t.y(), t.z()), matrix, distortion, pixel);
      EXPECT_NEAR(pixel[0].x, u, 1e-5);
      EXPECT_NEAR(pixel[0].y, v, 1e-5);
    }
  }
  EXPECT_GT(fixes, 30);
}

TEST_P(ProjectorLaws, ReprojectIsTheInverse) {
  const Projector projector(config(), kCamera);
  const Rigid3d enu_from_camera = pose(GetParam());
  for (double v = 10; v < 720; v += 50) {
    const auto fix = projector.project({700.0, v}, enu_from_camera);
    if (!fix) continue;
    const auto pixel = projector.reproject(fix->position_in_enu, enu_from_camera);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(700.0, v)).norm(), 1e-6);
  }
}

TEST_P(ProjectorLaws, StatedCovarianceIsTheSampledOne) {
  const Projector projector(config(), kCamera);
  const Rigid3d enu_from_camera = pose(GetParam());
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
  const Projector projector(config(), kCamera);
  const Rigid3d enu_from_camera = pose(GetParam());
  std::vector<Eigen::Vector2d> pixels;
  for (double v = -100; v < 800; v += 37) pixels.emplace_back(1.3 * v, v);
  std::vector<Expected<GroundFix, NoFix>> fixes;
  projector.project(pixels, enu_from_camera, fixes);
  ASSERT_EQ(fixes.size(), pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto single = projector.project(pixels[i], enu_from_camera);
    ASSERT_EQ(fixes[i].has_value(), single.has_value());
    if (!single) continue;
    EXPECT_EQ(fixes[i]->position_in_enu, single->position_in_enu);
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, ProjectorLaws,
                         ::testing::Values(Regime{"nadir", 20, -90, 0, 30},
                                           Regime{"banked", 20, -90, 25, 200},
                                           Regime{"oblique", 60, -45, -10, 300},
                                           Regime{"grazing", 80, -20, 2, 95}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Projector, TellsWhyThereIsNoFix) {
  ProjectorConfig config;
  config.max_range_m = 100.0;
  const Projector projector(config, CameraIntrinsics{});
  const Eigen::Vector2d centre{639.5, 359.5};
  const auto reason = [&](double height_m, double pitch_deg) {
    return projector.project(centre, pose({"", height_m, pitch_deg, 0, 0})).error();
  };
  EXPECT_EQ(reason(20, 10), NoFix::kAboveHorizon);
  EXPECT_EQ(reason(5, -4), NoFix::kTooGrazing);
  EXPECT_EQ(reason(50, -20), NoFix::kTooFar);
  EXPECT_EQ(reason(-1, -90), NoFix::kBelowGround);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(projector.project({nan, 0}, pose({"", 20, -90, 0, 0})).error(), NoFix::kNotFinite);
  EXPECT_EQ(reason(nan, -90), NoFix::kNotFinite);
  const Projector folded(config, {1280, 720, 914, 914, 639.5, 359.5, {-0.24, 0, 0, 0, 0}});
  EXPECT_EQ(folded.project({5000.0, 360.0}, pose({"", 20, -90, 0, 0})).error(), NoFix::kNoRay);
  EXPECT_FALSE(projector.reproject({0.0, 0.0}, pose({"", 20, 80, 0, 0})));  // behind
}

TEST(Projector, SeesWhatIsInTheImageAwayFromItsEdge) {
  const Projector projector({}, CameraIntrinsics{});
  const Rigid3d down = pose({"", 20, -90, 0, 0});
  EXPECT_TRUE(projector.sees(down.translation.head<2>(), down, 40.0));
  EXPECT_FALSE(projector.sees({down.translation.x() + 13.6, down.translation.y()}, down, 40.0));
  EXPECT_TRUE(projector.sees({down.translation.x() + 13.6, down.translation.y()}, down, 0.0));
  EXPECT_FALSE(projector.sees({1000.0, 1000.0}, down, 0.0));
}

}  // namespace
}  // namespace geoloc
