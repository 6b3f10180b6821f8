// SPDX-License-Identifier: Apache-2.0
// What is promised of a camera whose mount comes with each frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Pose;

Pose rolling_northwards(double time_s) {
  return {{0.0, 5.0 * time_s, 20.0}, 0.05 * std::sin(time_s), 0.03, 0.0};
}

FrameDetections empty_frame(double time_s) {
  FrameDetections frame;
  frame.captured_at = testing::at_s(time_s);
  frame.captured_at_host = testing::host_at_s(time_s);
  return frame;
}

TEST(Gimbal, FramesWithAMountOfTheirOwnAreLocatedAsByACameraMountedSo) {
  for (const double pitch_deg : {-90.0, -60.0, -45.0}) {
    for (const double yaw_deg : {0.0, 90.0, -130.0}) {
      CameraMount mount;
      mount.roll_deg = 3.0;
      mount.pitch_deg = pitch_deg;
      mount.yaw_deg = yaw_deg;
      mount.x_m = 0.3;
      GeolocatorConfig config;
      NadirFlight by_frame(config, rolling_northwards);
      config.camera.mount = mount;
      NadirFlight configured(config, rolling_northwards);
      FrameDetections frame = empty_frame(2.05);
      frame.detections = {testing::box_at({640, 360}), testing::box_at({300, 500})};
      by_frame.fly_until(2.05);
      configured.fly_until(2.05);
      ASSERT_TRUE(configured.geolocator().process(frame));
      frame.mount = mount;
      ASSERT_TRUE(by_frame.geolocator().process(frame));
      const auto& expected = configured.geolocator().located();
      const auto& located = by_frame.geolocator().located();
      ASSERT_EQ(located.size(), 2U);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(located[i].fix.position_in_enu, expected[i].fix.position_in_enu);
    }
  }
}

/// Without a lever arm, a level vehicle's camera that is pitched so is that of a vehicle pitched as much.
TEST(Gimbal, ThatSwingsFindsEachObjectOnceAndWhereItIs) {
  const std::vector<Eigen::Vector2d> places{{-6, 12}, {4, 18}, {-3, 24}, {6, 30}, {0, 37}};
  const testing::Path level = testing::northwards(5.0);
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    GeolocatorConfig config;
    config.method = method;
    NadirFlight flight(config, level);
    for (double time_s = 1.0; time_s < 9.0; time_s += 0.1) {
      const double up_rad = 0.25 + 0.25 * std::sin(1.5 * time_s);
      Pose camera = level(time_s);
      camera.pitch = up_rad;
      FrameDetections frame = empty_frame(time_s);
      frame.mount.emplace();
      frame.mount->pitch_deg = -90.0 + up_rad * kDegPerRad;
      for (const Eigen::Vector2d& place : places) {
        const auto pixel = testing::pixel_of(place, camera);
        if (pixel && std::abs(pixel->x() - 640.0) < 600.0 && std::abs(pixel->y() - 360.0) < 320.0)
          frame.detections.push_back(testing::box_at(*pixel));
      }
      flight.fly_until(time_s);
      ASSERT_TRUE(flight.geolocator().process(frame));
    }
    std::size_t confirmed = 0;
    for (const Track& track : flight.tracks()) {
      if (track.status != TrackStatus::kConfirmed) continue;
      ++confirmed;
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& place : places)
        nearest_m = std::min(nearest_m, (track.position_in_enu.mean - place).norm());
      EXPECT_LT(nearest_m, 0.02) << static_cast<int>(method);
    }
    EXPECT_EQ(confirmed, places.size()) << static_cast<int>(method);
  }
}

TEST(Gimbal, AMountThatCannotBeIsCountedAndChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  NadirFlight flight({}, rolling_northwards);
  flight.fly_until(1.0);
  for (const double pitch_deg : {nan, 1e300, -361.0}) {
    FrameDetections frame = empty_frame(1.0);
    frame.detections = {testing::box_at({640, 360})};
    frame.mount.emplace();
    frame.mount->pitch_deg = pitch_deg;
    EXPECT_FALSE(flight.geolocator().process(frame));
  }
  const auto& counters = flight.geolocator().counters();
  EXPECT_EQ(counters.frames_by_fate[static_cast<std::size_t>(FrameFate::kUnusableMount)], 3U);
  EXPECT_TRUE(flight.tracks().empty());
}

}  // namespace
}  // namespace geoloc
