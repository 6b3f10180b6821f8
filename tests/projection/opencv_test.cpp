// SPDX-License-Identifier: Apache-2.0
// OpenCV itself as the oracle, where it is installed.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "projection/regimes.hpp"

namespace geoloc {
namespace {

class ProjectorAgainstOpenCv : public ::testing::TestWithParam<Regime> {};

/// Where OpenCV shows a point.
Eigen::Vector2d opencv_pixel(const Eigen::Vector3d& point_in_enu, const Rigid3d& enu_from_camera) {
  cv::Matx33d camera_from_enu;
  cv::eigen2cv(Eigen::Matrix3d(enu_from_camera.rotation.conjugate().toRotationMatrix()), camera_from_enu);
  const Eigen::Vector3d t = enu_from_camera.inverse().translation;
  cv::Vec3d rotation_vector;
  cv::Rodrigues(camera_from_enu, rotation_vector);
  const cv::Matx33d matrix(kCamera.fx_px, 0, kCamera.cx_px, 0, kCamera.fy_px, kCamera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(kCamera.distortion.begin(), kCamera.distortion.end());
  const std::vector<cv::Point3d> points{{point_in_enu.x(), point_in_enu.y(), point_in_enu.z()}};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, rotation_vector, cv::Vec3d(t.x(), t.y(), t.z()), matrix, distortion, pixels);
  return {pixels[0].x, pixels[0].y};
}

TEST_P(ProjectorAgainstOpenCv, OpenCvProjectsTheFixBackToItsPixel) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  int fixes = 0;
  for (double u = 0; u < 1280; u += 91) {
    for (double v = 0; v < 720; v += 67) {
      const auto fix = projector.project({u, v}, enu_from_camera);
      if (!fix) continue;
      ++fixes;
      const Eigen::Vector3d ground(fix->position_in_enu.x(), fix->position_in_enu.y(), 1.5);
      EXPECT_LT((opencv_pixel(ground, enu_from_camera) - Eigen::Vector2d(u, v)).norm(), 1e-5);
    }
  }
  EXPECT_GT(fixes, 30);
}

TEST_P(ProjectorAgainstOpenCv, APointOfAnyHeightAppearsWhereOpenCvShowsIt) {
  const Projector projector(ground_at_1_5_m(), kCamera);
  const Rigid3d enu_from_camera = pose_of(GetParam());
  int points = 0;
  for (double u = 50; u < 1280; u += 197) {
    for (double v = 50; v < 720; v += 103) {
      const auto fix = projector.project({u, v}, enu_from_camera);
      if (!fix) continue;
      for (const double up_m : {-4.0, 0.0, 3.0}) {
        const Eigen::Vector3d point(fix->position_in_enu.x(), fix->position_in_enu.y(), up_m);
        const auto pixel = projector.reproject(point, enu_from_camera);
        if (!pixel) continue;  // beyond the lens model
        ++points;
        EXPECT_LT((opencv_pixel(point, enu_from_camera) - *pixel).norm(), 1e-5);
      }
    }
  }
  EXPECT_GT(points, 60);
}

INSTANTIATE_TEST_SUITE_P(Regimes, ProjectorAgainstOpenCv, every_regime(), regime_name);

}  // namespace
}  // namespace geoloc
