// SPDX-License-Identifier: Apache-2.0
// What is promised of objects where the vehicle's own state jumps, seen from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/allocation_counter.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::expect_each_place_once;
using testing::NadirFlight;
using testing::Path;
using testing::Pose;

constexpr double kJump_s = 9.95;

/// Along a lane and back, 20 m up.
Pose to_and_fro(double time_s) {
  const double north_m = 20.0 + 20.0 * std::sin(0.25 * time_s - 1.5);
  return {{0.0, north_m - 20.0 - 20.0 * std::sin(-1.5), 20.0}, 0.03 * std::sin(time_s), 0.02, 0.0};
}

struct Jump {
  Pose by;
  double until_s;
};

Path told_of(const Jump& jump) {
  return [=](double time_s) {
    Pose pose = to_and_fro(time_s);
    if (time_s < kJump_s || time_s >= jump.until_s) return pose;
    pose.position += jump.by.position;
    pose.yaw += jump.by.yaw;
    return pose;
  };
}

const std::vector<Eigen::Vector2d> kPlaces{{-6, 2}, {4, 8}, {-3, 14}, {7, 20}, {0, 27}, {-7, 33}, {5, 38}};

TEST(StateJumps, MoveNoObjectAndMakeNone) {
  const Jump jumps[] = {{{{40, -30, 0}, 0, 0, 0}, 14.95},
                        {{{-1.8, 2.4, 0}, 0, 0, 0}, 1e9},
                        {{{0, 0, 10}, 0, 0, 0}, 1e9},
                        {{{0, 0, 0}, 0, 0, 20.0 * kRadPerDeg}, 1e9}};
  for (const Method method : {Method::kJoint, Method::kPaper}) {
    for (const Jump& jump : jumps) {
      GeolocatorConfig config;
      config.method = method;
      NadirFlight flight(config, told_of(jump), to_and_fro);
      int lost = 0;
      for (int i = 0; i < 300; ++i) lost += flight.see(0.1 * i, kPlaces) ? 0 : 1;
      EXPECT_LE(lost, 2) << "only where the state steps";
      if (method == Method::kJoint) expect_each_place_once(kPlaces, flight.tracks());
      const auto confirmed =
          std::count_if(flight.tracks().begin(), flight.tracks().end(),
                        [](const Track& track) { return track.status == TrackStatus::kConfirmed; });
      EXPECT_EQ(confirmed, static_cast<std::ptrdiff_t>(kPlaces.size()));
    }
  }
}

/// Nothing hangs on what came before the first object: the vehicle is more often right later.
TEST(StateJumps, BeforeAnyObjectIsKnownAreBelieved) {
  const Path told = [](double time_s) {
    Pose pose = to_and_fro(time_s);
    if (time_s < 3.0) {
      pose.position += Eigen::Vector3d(0, 0, 6);
      pose.yaw += 0.4;
    }
    return pose;
  };
  NadirFlight flight(GeolocatorConfig{}, told, to_and_fro);
  for (int i = 0; i < 30; ++i) flight.see(0.1 * i, {});
  for (int i = 30; i < 300; ++i) flight.see(0.1 * i, kPlaces);
  expect_each_place_once(kPlaces, flight.tracks());
}

TEST(StateJumps, AllocateNothing) {
  NadirFlight flight(GeolocatorConfig{}, told_of({{{40, -30, 5}, 0, 0, 0.4}, 14.95}), to_and_fro);
  for (int i = 0; i < 90; ++i) flight.see(0.1 * i, kPlaces);
  Geolocator& geolocator = flight.geolocator();
  std::vector<FrameDetections> frames;
  for (int i = 90; i < 200; ++i) {
    FrameDetections frame;
    frame.captured_at = testing::at_s(0.1 * i);
    frame.captured_at_host = testing::host_at_s(0.1 * i);
    for (const Eigen::Vector2d& place : kPlaces) {
      if (const auto pixel = flight.shown(0.1 * i, place))
        frame.detections.push_back(testing::box_at(*pixel));
    }
    frames.push_back(frame);
  }
  const std::size_t before = testing::allocations();
  std::size_t located = 0;
  for (const FrameDetections& frame : frames) {
    flight.fly_until(seconds(frame.captured_at.time_since_epoch()));
    if (geolocator.process(frame)) ++located;
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GE(located, frames.size() - 2) << "all but those between the samples around a jump";
  EXPECT_GE(geolocator.state().steps().segment, 4U);
}

}  // namespace
}  // namespace geoloc
