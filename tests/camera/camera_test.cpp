// SPDX-License-Identifier: Apache-2.0
#include "geoloc/camera/camera.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

struct Lens {
  const char* name;
  std::array<double, 5> distortion;
};

CameraIntrinsics camera_with(const std::array<double, 5>& distortion) {
  return {1280, 720, 905.3, 911.7, 631.2, 366.4, distortion};
}

class CameraLaws : public ::testing::TestWithParam<Lens> {};

TEST_P(CameraLaws, PixelIsOpenCvsProjectPoints) {
  const CameraIntrinsics k = camera_with(GetParam().distortion);
  const CameraModel camera(k);
  const cv::Matx33d matrix(k.fx_px, 0, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1);
  const std::vector<double> distortion(k.distortion.begin(), k.distortion.end());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-12, 12), y(-7, 7), z(18, 80);
  for (int i = 0; i < 500; ++i) {
    const cv::Point3d point(x(random), y(random), z(random));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{point}, cv::Vec3d(), cv::Vec3d(), matrix, distortion,
                      expected);
    const auto pixel = camera.pixel({point.x, point.y, point.z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
  }
}

TEST_P(CameraLaws, RayIsTheInverseOfPixelOverTheWholeImage) {
  const CameraModel camera(camera_with(GetParam().distortion));
  for (double u = -0.5; u <= 1279.5; u += 80) {
    for (double v = -0.5; v <= 719.5; v += 45) {
      const auto ray = camera.ray({u, v});
      ASSERT_TRUE(ray) << u << ", " << v;
      const auto pixel = camera.pixel(ray->normalized.homogeneous());
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - Eigen::Vector2d(u, v)).norm(), 1e-7);
    }
  }
}

TEST_P(CameraLaws, JacobianIsTheNumericDerivative) {
  const CameraModel camera(camera_with(GetParam().distortion));
  const Eigen::Vector2d pixel{200.0, 600.0};
  const double step_px = 1e-3;
  const auto ray = camera.ray(pixel);
  ASSERT_TRUE(ray);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d moved = step_px * Eigen::Vector2d::Unit(axis);
    const Eigen::Vector2d slope =
        (camera.ray(pixel + moved)->normalized - camera.ray(pixel - moved)->normalized) / (2.0 * step_px);
    EXPECT_LT((slope - ray->normalized_from_pixel.col(axis)).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, CameraLaws,
                         ::testing::Values(Lens{"pinhole", {}},
                                           Lens{"barrel", {-0.28, 0.09, 0.001, -0.0005, -0.01}},
                                           Lens{"pincushion", {0.12, -0.02, -0.002, 0.001, 0.0}}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Camera, RefusesPixelsBeyondItsLensModel) {
  // This barrel folds back at 1.18 from the axis: pixels beyond have no bearing, points beyond no pixel.
  const CameraModel camera(camera_with({-0.24, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.ray({5000.0, 360.0}));
  EXPECT_FALSE(camera.pixel({1.3, 0.0, 1.0}));
  EXPECT_TRUE(camera.pixel({1.0, 0.0, 1.0}));
}

TEST(Camera, RefusesWhatIsBehindOrNotANumber) {
  const CameraModel camera{CameraIntrinsics{}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(camera.pixel({0, 0, -1}));
  EXPECT_FALSE(camera.pixel({0, 0, 0}));
  EXPECT_FALSE(camera.pixel({nan, 0, 1}));
  EXPECT_FALSE(camera.ray({nan, 0}));
  EXPECT_FALSE(camera.contains({nan, 10}));
}

TEST(Camera, FieldOfViewSpansTheOuterEdges) {
  const auto k = CameraIntrinsics::from_field_of_view(1280, 720, 70.0);
  const CameraModel camera(k);
  const double left = std::atan(camera.ray({-0.5, 359.5})->normalized.x());
  const double right = std::atan(camera.ray({1279.5, 359.5})->normalized.x());
  EXPECT_NEAR((right - left) * kDegPerRad, 70.0, 1e-9);
  EXPECT_NEAR(k.fx_px, CameraIntrinsics{}.fx_px, 0.01);  // the default camera has this field of view
}

TEST(Box, CentreOfASinglePixelIsItsIntegerCoordinate) {
  const Box pixel_at_7_3{7.0, 3.0, 1.0, 1.0};  // continuous edges around the pixel
  EXPECT_EQ(pixel_at_7_3.centre(), Eigen::Vector2d(7.0, 3.0));
}

TEST(Mount, StraightDownHasTheImageTopTowardsTheNose) {
  const Rigid3d pose = body_from_camera(CameraMount{});
  EXPECT_TRUE(
      (pose.rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d(0, 0, 1), 1e-12));  // looks down
  EXPECT_TRUE(
      (pose.rotation * -Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));  // top: nose
  EXPECT_TRUE(
      (pose.rotation * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));  // right: right
}

TEST(Mount, ForwardLookingIsTheZeroMount) {
  const Rigid3d pose = body_from_camera({0, 0, 0, 0.1, 0.2, 0.3});
  EXPECT_TRUE((pose.rotation * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_EQ(pose.translation, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(CameraConfig, NamesEveryProblem) {
  CameraConfig config;
  config.intrinsics.width_px = 0;
  config.intrinsics.fx_px = -1;
  config.intrinsics.cy_px = std::numeric_limits<double>::quiet_NaN();
  config.mount.pitch_deg = std::numeric_limits<double>::infinity();
  EXPECT_EQ(config.problems().size(), 4U);
  EXPECT_THROW(CameraModel{config.intrinsics}, std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
