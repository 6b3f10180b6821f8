// SPDX-License-Identifier: Apache-2.0
// What is promised of objects where the camera's clock steps in mid-flight, seen from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/allocation_counter.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::expect_each_place_once;
using testing::in_gusts;
using testing::NadirFlight;

constexpr double kStep_s = 40.0, kEarlyStep_s = 20.0, kEnd_s = 80.0;

const std::vector<Eigen::Vector2d> kPlaces{{-6, 2}, {4, 8}, {-3, 14}, {7, 20}, {0, 27}, {-7, 33}, {5, 38}};

/// Frames ten times a second, of a perfect detector; from mid-flight on they are stamped so much later, and a
/// receiver takes none until a clock that was set back has caught up.
std::vector<FrameDetections> frames_with_step(const NadirFlight& flight, double step_s,
                                              double step_at_s = kStep_s) {
  std::vector<FrameDetections> frames;
  for (double exposed_s = 0.0; exposed_s < kEnd_s; exposed_s += 0.1) {
    const double stamp_s = exposed_s + (exposed_s >= step_at_s ? step_s : 0.0);
    FrameDetections frame;
    frame.captured_at = testing::at_s(stamp_s);
    frame.captured_at_host = testing::host_at_s(stamp_s);
    if (!frames.empty() && frame.captured_at <= frames.back().captured_at) continue;
    for (const Eigen::Vector2d& place : kPlaces) {
      if (const auto pixel = flight.shown(exposed_s, place))
        frame.detections.push_back(testing::box_at(*pixel));
    }
    frames.push_back(frame);
  }
  return frames;
}

class CameraClock : public ::testing::TestWithParam<double> {};

TEST_P(CameraClock, ThatStepsMovesNoObjectLosesNoneAndMakesNone) {
  NadirFlight flight(GeolocatorConfig{}, in_gusts);
  for (const FrameDetections& frame : frames_with_step(flight, GetParam())) {
    flight.fly_until(seconds(frame.captured_at.time_since_epoch()) + 3.0);
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  const Geolocator& geolocator = flight.geolocator();
  expect_each_place_once(kPlaces, geolocator.tracks());
  EXPECT_EQ(geolocator.track_counters().latency_changes, 1U);
  EXPECT_NEAR(geolocator.calibration()->latency_s(), GetParam(), 0.03);
}

/// What was seen before is not forgotten, as it is where the latency was another from the flight's start on.
TEST_P(CameraClock, ThatStepsSoonAfterTheStartLosesNoObject) {
  NadirFlight flight(GeolocatorConfig{}, in_gusts);
  std::vector<std::uint64_t> before;
  for (const FrameDetections& frame : frames_with_step(flight, GetParam(), kEarlyStep_s)) {
    const double time_s = seconds(frame.captured_at.time_since_epoch());
    flight.fly_until(time_s + 3.0);
    EXPECT_TRUE(flight.geolocator().process(frame));
    if (std::abs(time_s - (kEarlyStep_s - 0.5)) > 0.01) continue;
    for (const Track& track : flight.geolocator().tracks()) {
      if (track.status == TrackStatus::kConfirmed) before.push_back(track.id);
    }
  }
  const std::vector<Track>& tracks = flight.geolocator().tracks();
  expect_each_place_once(kPlaces, tracks);
  EXPECT_GT(before.size(), 3U);
  EXPECT_EQ(flight.geolocator().track_counters().latency_changes, 1U);
  for (const std::uint64_t id : before)
    EXPECT_TRUE(
        std::any_of(tracks.begin(), tracks.end(), [id](const Track& track) { return track.id == id; }));
}

INSTANTIATE_TEST_SUITE_P(MidFlight, CameraClock, ::testing::Values(-2.9, -1.0, -0.3, 0.3, 1.0, 2.9));

TEST(CameraClock, ThatDoesNotStepIsBelieved) {
  NadirFlight flight(GeolocatorConfig{}, in_gusts);
  for (const FrameDetections& frame : frames_with_step(flight, 0.0)) {
    flight.fly_until(seconds(frame.captured_at.time_since_epoch()));
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  expect_each_place_once(kPlaces, flight.tracks());
  EXPECT_EQ(flight.geolocator().track_counters().latency_changes, 0U);
}

/// One frame that is shaken, and a detector that sees nothing for a second, are no step.
TEST(CameraClock, IsBelievedWhereAFrameIsShakenOrEmpty) {
  NadirFlight flight(GeolocatorConfig{}, in_gusts);
  for (FrameDetections& frame : frames_with_step(flight, 0.0)) {
    const double time_s = seconds(frame.captured_at.time_since_epoch());
    if (std::abs(time_s - 40.0) < 0.01)
      for (Detection& detection : frame.detections) detection.box.x += 60.0;
    if (time_s > 50.0 && time_s < 51.0) frame.detections.clear();
    flight.fly_until(time_s);
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  expect_each_place_once(kPlaces, flight.tracks());
  EXPECT_EQ(flight.geolocator().track_counters().latency_changes, 0U);
}

TEST(CameraClock, ThatStepsCausesNoAllocation) {
  NadirFlight flight(GeolocatorConfig{}, in_gusts);
  const std::vector<FrameDetections> frames = frames_with_step(flight, 1.0);
  const auto half = static_cast<std::ptrdiff_t>(frames.size() / 2) - 20;
  NadirFlight again(GeolocatorConfig{}, in_gusts);
  Geolocator& geolocator = again.geolocator();
  std::size_t allocations = 0;
  for (auto frame = frames.begin(); frame != frames.end(); ++frame) {
    again.fly_until(seconds(frame->captured_at.time_since_epoch()) + 3.0);
    const std::size_t before = testing::allocations();
    EXPECT_TRUE(geolocator.process(*frame));
    if (frame - frames.begin() >= half) allocations += testing::allocations() - before;
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_EQ(geolocator.track_counters().latency_changes, 1U);
}

}  // namespace
}  // namespace geoloc
