// SPDX-License-Identifier: Apache-2.0
#include "geoloc/camera/camera.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "camera/lenses.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

class CameraLaws : public ::testing::TestWithParam<Lens> {};

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
  const double step_px = 1e-3;
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(200, 600), {1100, 80}, {640, 20}, {30, 360}}) {
    const auto ray = camera.ray(pixel);
    ASSERT_TRUE(ray);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d moved = step_px * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope =
          (camera.ray(pixel + moved)->normalized - camera.ray(pixel - moved)->normalized) / (2.0 * step_px);
      EXPECT_LT((slope - ray->normalized_from_pixel.col(axis)).norm(), 1e-9);
    }
  }
}

/// Without inverting the lens.
TEST_P(CameraLaws, RayToAPointIsThatOfItsPixel) {
  const CameraModel camera(camera_with(GetParam().distortion));
  for (double x = -0.9; x <= 0.9; x += 0.15) {
    for (double y = -0.5; y <= 0.5; y += 0.25) {
      const Eigen::Vector3d point = 40.0 * Eigen::Vector3d(x, y, 1.0);
      const auto pixel = camera.pixel(point);
      const auto found = camera.ray_to(point);
      ASSERT_EQ(found.has_value(), pixel.has_value()) << x << ", " << y;
      if (!pixel) continue;
      const auto expected = camera.ray(*pixel);
      ASSERT_TRUE(expected);
      EXPECT_LT((found->normalized - expected->normalized).norm(), 1e-9);
      EXPECT_LT((found->normalized_from_pixel - expected->normalized_from_pixel).norm(), 1e-11);
    }
  }
  EXPECT_FALSE(camera.ray_to({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.ray_to({0.0, std::numeric_limits<double>::quiet_NaN(), 1.0}));
}

INSTANTIATE_TEST_SUITE_P(Lenses, CameraLaws, every_lens(), lens_name);

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

TEST(Mount, TurnsByYawThenPitchThenRoll) {
  const auto turned = [](const CameraMount& mount, const Eigen::Vector3d& axis) {
    return Eigen::Vector3d(body_from_camera(mount).rotation * axis);
  };
  const Eigen::Vector3d looks = Eigen::Vector3d::UnitZ(), top = -Eigen::Vector3d::UnitY();
  EXPECT_TRUE(turned({0, 0, 90, 0, 0, 0}, looks).isApprox(Eigen::Vector3d(0, 1, 0)));    // to the right
  EXPECT_TRUE(turned({90, 0, 0, 0, 0, 0}, top).isApprox(Eigen::Vector3d(0, 1, 0)));      // top to the right
  EXPECT_TRUE(turned({0, -90, 90, 0, 0, 0}, looks).isApprox(Eigen::Vector3d(0, 0, 1)));  // down,
  EXPECT_TRUE(turned({0, -90, 90, 0, 0, 0}, top).isApprox(Eigen::Vector3d(0, 1, 0)));    // top to the right
  EXPECT_TRUE(turned({0, 30, 0, 0, 0, 0}, looks).isApprox(Eigen::Vector3d(std::sqrt(0.75), 0, -0.5)));
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

struct FieldLimits {
  const char* field;
  double inside, outside;
  void (*set)(CameraConfig&, double);
};

TEST(CameraConfig, EachFieldHasItsLimits) {
  const double infinity = std::numeric_limits<double>::infinity();
  const FieldLimits limits[] = {
      {"width", 1, 0, [](CameraConfig& c, double v) { c.intrinsics.width_px = static_cast<int>(v); }},
      {"width", 32768, 32769, [](CameraConfig& c, double v) { c.intrinsics.width_px = static_cast<int>(v); }},
      {"height", 1, 0, [](CameraConfig& c, double v) { c.intrinsics.height_px = static_cast<int>(v); }},
      {"height", 32768, 32769,
       [](CameraConfig& c, double v) { c.intrinsics.height_px = static_cast<int>(v); }},
      {"fx", 12.8, 0, [](CameraConfig& c, double v) { c.intrinsics.fx_px = v; }},
      {"fx", 1.28e7, infinity, [](CameraConfig& c, double v) { c.intrinsics.fx_px = v; }},
      {"fy", 7.2, 0, [](CameraConfig& c, double v) { c.intrinsics.fy_px = v; }},
      {"fy", 7.2e6, infinity, [](CameraConfig& c, double v) { c.intrinsics.fy_px = v; }},
      {"fx", 914, 1e-12, [](CameraConfig& c, double v) { c.intrinsics.fx_px = v; }},
      {"fx", 914, 1e300, [](CameraConfig& c, double v) { c.intrinsics.fx_px = v; }},
      {"fy", 914, 7, [](CameraConfig& c, double v) { c.intrinsics.fy_px = v; }},
      {"cx", 0, 1e300, [](CameraConfig& c, double v) { c.intrinsics.cx_px = v; }},
      {"distortion", 1e3, -1e300, [](CameraConfig& c, double v) { c.intrinsics.distortion[0] = v; }},
      {"cx", -1e6, -infinity, [](CameraConfig& c, double v) { c.intrinsics.cx_px = v; }},
      {"cy", 1e6, infinity, [](CameraConfig& c, double v) { c.intrinsics.cy_px = v; }},
      {"distortion", -9, infinity, [](CameraConfig& c, double v) { c.intrinsics.distortion[4] = v; }},
      {"mount", 360, 360.1, [](CameraConfig& c, double v) { c.mount.roll_deg = v; }},
      {"mount", -360, -360.1, [](CameraConfig& c, double v) { c.mount.pitch_deg = v; }},
      {"mount", 360, 360.1, [](CameraConfig& c, double v) { c.mount.yaw_deg = v; }},
      {"mount", 100, 100.1, [](CameraConfig& c, double v) { c.mount.x_m = v; }},
      {"mount", -100, -100.1, [](CameraConfig& c, double v) { c.mount.y_m = v; }},
      {"mount", 100, 100.1, [](CameraConfig& c, double v) { c.mount.z_m = v; }},
  };
  for (const FieldLimits& limit : limits) {
    CameraConfig config;
    limit.set(config, limit.inside);
    EXPECT_TRUE(config.problems().empty()) << limit.field << " " << limit.inside;
    limit.set(config, limit.outside);
    ASSERT_EQ(config.problems().size(), 1U) << limit.field << " " << limit.outside;
    EXPECT_NE(config.problems().front().find(limit.field), std::string::npos) << config.problems().front();
  }
}

}  // namespace
}  // namespace geoloc
