// SPDX-License-Identifier: Apache-2.0
#include "tracking/visibility.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace geoloc {
namespace {

constexpr double kFocal_px = 1000.0, kAltitude_m = 20.0;
constexpr int kImageWidth_px = 1280, kImageHeight_px = 720;
constexpr double kCentreNoise_px = 1.5, kSmallest_px = 6.0;

/// A level vehicle above the origin that flies north, its camera looking straight down: a pixel is 2 cm of
/// ground. Camera right is east, camera down is south.
double visibility_of(const ShownObject& object, double smallest_px = kSmallest_px) {
  CameraIntrinsics intrinsics;
  intrinsics.width_px = kImageWidth_px;
  intrinsics.height_px = kImageHeight_px;
  intrinsics.fx_px = intrinsics.fy_px = kFocal_px;
  intrinsics.cx_px = (kImageWidth_px - 1) / 2.0;
  intrinsics.cy_px = (kImageHeight_px - 1) / 2.0;
  FrameView view;
  const Eigen::Matrix3d looking_down = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  view.enu_from_camera = {Eigen::Quaterniond(looking_down), {0.0, 0.0, kAltitude_m}};
  return visibility(object, Projector({}, intrinsics), view, kCentreNoise_px, smallest_px);
}

ShownObject object_at(double east_m, double north_m, double size_m, double sigma_m = 0.0) {
  ShownObject object;
  object.position_in_enu = {east_m, north_m, 0.0};
  object.size_m = size_m;
  object.sigma_m = sigma_m;
  return object;
}

TEST(Visibility, RisesFromNothingAtTheSmallestSizeToAllAtTwiceThat) {
  const double ground_per_pixel_m = kAltitude_m / kFocal_px;
  EXPECT_EQ(visibility_of(object_at(0, 0, 0.5 * kSmallest_px * ground_per_pixel_m)), 0.0);
  for (const double share : {0.1, 0.25, 0.5, 0.9})
    EXPECT_NEAR(visibility_of(object_at(0, 0, (1.0 + share) * kSmallest_px * ground_per_pixel_m)), share,
                1e-9);
  EXPECT_EQ(visibility_of(object_at(0, 0, 2.5 * kSmallest_px * ground_per_pixel_m)), 1.0);
}

TEST(Visibility, OfAnythingIsFullWhereNothingIsTooSmall) {
  EXPECT_EQ(visibility_of(object_at(0, 0, 0.01), 0.0), 1.0);
}

TEST(Visibility, IsThatAtTheScaleOfTheGroundWhereThatIsStated) {
  ShownObject object = object_at(0, 0, 0.2);  // 10 px at 2 cm a pixel
  EXPECT_NEAR(visibility_of(object), 10.0 / kSmallest_px - 1.0, 1e-9);
  object.ground_per_pixel_m = 0.025;
  EXPECT_NEAR(visibility_of(object), 8.0 / kSmallest_px - 1.0, 1e-9);
}

/// Where the object first is cut off: east of the middle, and north of it.
double farthest_seen_m(const Eigen::Vector2d& direction, double size_m, double sigma_m) {
  double seen_m = 0.0, unseen_m = 50.0;
  while (unseen_m - seen_m > 1e-6) {
    const double middle_m = 0.5 * (seen_m + unseen_m);
    const Eigen::Vector2d place = middle_m * direction;
    (visibility_of(object_at(place.x(), place.y(), size_m, sigma_m)) > 0.0 ? seen_m : unseen_m) = middle_m;
  }
  return seen_m;
}

TEST(Visibility, EndsWhereTheBoxMayTouchTheImagesEdge) {
  const double ground_per_pixel_m = kAltitude_m / kFocal_px;
  const double size_px = 40.0;
  for (const double sigma_px : {0.0, 10.0, 40.0, 500.0}) {
    // 0.6 of its size, and two sigmas of where it is (no more than twice its size) and of the box's centre.
    const double margin_px = 0.6 * size_px + 2.0 * std::min(sigma_px, size_px) + 2.0 * kCentreNoise_px;
    const double size_m = size_px * ground_per_pixel_m, sigma_m = sigma_px * ground_per_pixel_m;
    for (const double side : {-1.0, 1.0}) {
      EXPECT_NEAR(farthest_seen_m({side, 0}, size_m, sigma_m),
                  ground_per_pixel_m * (0.5 * kImageWidth_px - margin_px), 1e-3);
      EXPECT_NEAR(farthest_seen_m({0, side}, size_m, sigma_m),
                  ground_per_pixel_m * (0.5 * kImageHeight_px - margin_px), 1e-3);
    }
  }
}

/// On a hill of 4 m the object is 16 m away: it is at the image's edge where the ground is not yet.
TEST(Visibility, EndsEarlierOnAHill) {
  const double half_image_m = 0.5 * kImageWidth_px * kAltitude_m / kFocal_px;
  for (const double share : {0.75, 0.85}) {
    ShownObject object = object_at(share * half_image_m, 0, 0.2);
    EXPECT_GT(visibility_of(object), 0.0);
    object.position_in_enu.z() = 4.0;
    EXPECT_EQ(visibility_of(object) > 0.0, share < 0.8);
  }
}

TEST(Visibility, OfWhatIsBehindTheCameraIsNone) {
  FrameView view;  // looks straight up
  view.enu_from_camera.translation.z() = kAltitude_m;
  const Projector projector({}, CameraIntrinsics{});
  EXPECT_EQ(visibility(object_at(0, 0, 1.0), projector, view, kCentreNoise_px, kSmallest_px), 0.0);
}

/// The camera looks north, a little down: what is far is small, and beyond the projector's reach is nothing.
TEST(Visibility, FallsWithTheDistanceAndEndsAtTheProjectorsRange) {
  ProjectorConfig config;
  config.max_range_m = 150.0;
  config.min_depression_deg = 1.0;
  const Projector projector(config, CameraIntrinsics{});
  FrameView view;
  const double down = std::sin(0.25), ahead = std::cos(0.25);  // [rad] below the horizon
  Eigen::Matrix3d enu_from_camera;
  enu_from_camera << 1, 0, 0, 0, -down, ahead, 0, -ahead, -down;
  view.enu_from_camera = {Eigen::Quaterniond(enu_from_camera), {0.0, 0.0, 30.0}};
  double before = 1.0;
  for (const double north_m : {90.0, 110.0, 130.0, 145.0}) {
    // At slant range r a pixel spans r / f across and r^2 / (f h) along the ground.
    const double range_m = std::hypot(north_m, 30.0);
    const double aside_m_px = range_m / CameraIntrinsics{}.fx_px;
    const double deep_m_px = aside_m_px * range_m / 30.0;
    const double along_axis =
        north_m * ahead / range_m + 30.0 * down / range_m;  // cosine of the pixel's angle
    const double expected_m_px = std::sqrt(aside_m_px * deep_m_px) * std::pow(along_axis, 1.5);
    const double size_m = 2.5;
    const double expected = std::min(1.0, size_m / expected_m_px / 6.0 - 1.0);
    const double actual = visibility(object_at(0, north_m, size_m), projector, view, kCentreNoise_px, 6.0);
    EXPECT_NEAR(actual, expected, 1e-9) << north_m;
    EXPECT_LE(actual, before);
    before = actual;
  }
  EXPECT_EQ(visibility(object_at(0, 149.0, 20.0), projector, view, kCentreNoise_px, 6.0), 0.0);
}

}  // namespace
}  // namespace geoloc
