// SPDX-License-Identifier: Apache-2.0
// What OpenCV computed once: tools/fixtures/make_camera_fixtures.py says how.
#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"
#include "projection/camera_pose.hpp"
#include "support/number_lines.hpp"
#include "support/opencv_lens.hpp"
#include "support/source_tree.hpp"

namespace geoloc {
namespace {

/// The camera's pose in a line `view NAME east north up roll pitch yaw mount_roll mount_pitch mount_yaw x y
/// z`.
Rigid3d enu_from_camera_of(const NumberLine& view) {
  const std::vector<double>& n = view.numbers;
  VehicleState state{};
  const EulerAngles attitude{n.at(3) * kRadPerDeg, n.at(4) * kRadPerDeg, n.at(5) * kRadPerDeg};
  state.enu_from_body = {enu_from_ned() * ned_from_body(attitude), {n.at(0), n.at(1), n.at(2)}};
  const CameraMount mount{n.at(6), n.at(7), n.at(8), n.at(9), n.at(10), n.at(11)};
  return enu_from_camera(state, mount, CameraOrientation::kComposed);
}

TEST(ProjectorAgainstOpenCvsNumbers, EachGroundPointAppearsWhereOpenCvShowsIt) {
  ProjectorConfig config;
  config.ground_height_above_home_m = 1.5;
  std::optional<Projector> projector, of_another_ground;
  Rigid3d enu_from_camera;
  int views = 0, points = 0;
  for (const NumberLine& line : read_number_lines(test_data() / "camera/views.txt")) {
    const std::vector<double>& n = line.numbers;
    if (line.word == "lens") {
      projector.emplace(config, intrinsics_of(line));
      of_another_ground.emplace(ProjectorConfig{}, intrinsics_of(line));
    } else if (line.word == "view") {
      enu_from_camera = enu_from_camera_of(line);
      ++views;
    } else if (line.word == "shows") {
      const Eigen::Vector2d ground(n.at(0), n.at(1)), pixel(n.at(2), n.at(3));
      const auto seen_at = projector->reproject(ground, enu_from_camera);
      const auto fix = projector->project(pixel, enu_from_camera);
      ASSERT_TRUE(seen_at && fix) << views << ": " << ground.transpose();
      EXPECT_LT((*seen_at - pixel).norm(), 1e-8) << views << ": " << ground.transpose();
      const auto point_seen_at = of_another_ground->reproject(
          Eigen::Vector3d(ground.x(), ground.y(), config.ground_height_above_home_m), enu_from_camera);
      ASSERT_TRUE(point_seen_at);
      EXPECT_LT((*point_seen_at - pixel).norm(), 1e-8) << views << ": " << ground.transpose();
      EXPECT_LT((fix->position_in_enu - ground).norm(), 1e-7) << views << ": " << ground.transpose();
      ++points;
    }
  }
  EXPECT_EQ(views, 4);
  EXPECT_EQ(points, 150);
}

}  // namespace
}  // namespace geoloc
