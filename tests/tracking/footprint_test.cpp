// SPDX-License-Identifier: Apache-2.0
#include "tracking/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

/// The camera looks `tilt_rad` from straight down to the north-west or so.
FrameView view_from(double height_m, double tilt_rad, double heading_rad) {
  FrameView view;
  view.enu_from_camera.translation = {12.0, -7.0, height_m};
  view.enu_from_camera.rotation = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(kPi - tilt_rad, Eigen::Vector3d::UnitX());
  return view;
}

/// Whatever the projector has a fix for, and whatever stands above or below it within the bound.
TEST(Footprint, HoldsAllThatAFrameShows) {
  const Projector projector({}, CameraIntrinsics{});
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share;
  int fixes = 0;
  for (int i = 0; i < 20'000; ++i) {
    const FrameView view =
        view_from(5.0 + 100.0 * share(random), 1.4 * share(random), 2.0 * kPi * share(random));
    const Eigen::AlignedBox2d box = footprint(projector, view, 3.0);
    const Eigen::Vector2d pixel(camera.width_px * share(random), camera.height_px * share(random));
    const auto fix = projector.project(pixel, view);
    if (!fix) continue;
    ++fixes;
    const Eigen::Vector2d from_nadir = fix->position_in_enu - view.enu_from_camera.translation.head<2>();
    const double height_m = view.enu_from_camera.translation.z();
    for (const double up_m : {-3.0, 0.0, 3.0}) {
      const double farther = (height_m - up_m) / height_m;
      const Eigen::Vector2d place = view.enu_from_camera.translation.head<2>() + farther * from_nadir;
      ASSERT_TRUE(box.contains(place)) << i << ' ' << place.transpose();
    }
  }
  EXPECT_GT(fixes, 10'000);
}

TEST(Footprint, OfACameraThatLooksDownIsLittleMoreThanItsImage) {
  const Projector projector({}, CameraIntrinsics{});
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  const Eigen::AlignedBox2d box = footprint(projector, view_from(20.0, 0.0, 0.0), 0.0);
  EXPECT_NEAR(box.sizes().x(), 1.1 * 20.0 * camera.width_px / camera.fx_px, 1e-9);
  EXPECT_NEAR(box.sizes().y(), 1.1 * 20.0 * camera.height_px / camera.fy_px, 1e-9);
}

TEST(Footprint, EndsWhereFixesDo) {
  const Projector projector({}, CameraIntrinsics{});
  for (const double height_m : {2.0, 20.0, 300.0, 2000.0}) {
    const FrameView view = view_from(height_m, 0.5 * kPi, 0.3);
    const Eigen::AlignedBox2d box = footprint(projector, view, 0.0);
    EXPECT_LE(box.sizes().maxCoeff(), 2.2 * projector.config().max_range_m);
    EXPECT_TRUE(box.sizes().allFinite());
  }
}

}  // namespace
}  // namespace geoloc
