// SPDX-License-Identifier: Apache-2.0
// What is promised where far more objects are on the map than in view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/allocation_counter.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Pose;

constexpr double kOut_s = 12.0, kAway_s = 60.0, kBack_s = kOut_s + kAway_s;
constexpr double kFar_m = 180.0;

/// Above the first places, far to the north and back, again and again.
Pose out_and_back(double time_s) {
  const double away_s = std::max(0.0, time_s - kOut_s);
  const double north_m = 0.5 * kFar_m * (1.0 - std::cos(2.0 * kPi * away_s / kAway_s));
  return {{0.0, north_m, 20.0}, 0.06 * std::sin(0.7 * time_s), 0.05 * std::cos(0.9 * time_s), 0.0};
}

std::vector<Eigen::Vector2d> grid(double north_from_m, double north_to_m, double spacing_m) {
  std::vector<Eigen::Vector2d> places;
  for (double north = north_from_m; north <= north_to_m; north += spacing_m) {
    for (double east = -8.0; east <= 8.0; east += spacing_m) places.emplace_back(east, north);
  }
  return places;
}

const std::vector<Eigen::Vector2d> kHere = grid(-4.0, 4.0, 4.0), kElsewhere = grid(30.0, kFar_m, 2.0);

std::vector<Eigen::Vector2d> everywhere() {
  std::vector<Eigen::Vector2d> places = kHere;
  places.insert(places.end(), kElsewhere.begin(), kElsewhere.end());
  return places;
}

/// Whatever the flight saw elsewhere, what is here keeps its ids, and stays where it is.
TEST(ManyObjects, ElsewhereChangeNothingHere) {
  std::map<std::uint64_t, Eigen::Vector2d> alone;
  for (const auto& places : {kHere, everywhere()}) {
    NadirFlight flight(GeolocatorConfig{}, out_and_back);
    for (double time_s = 0.5; time_s < kBack_s; time_s += 0.1) flight.see(time_s, places);
    testing::expect_each_place_once(places, flight.tracks());
    for (const Eigen::Vector2d& place : kHere) {
      const Track* const object = testing::object_at(place, flight.tracks(), 0.5);
      ASSERT_TRUE(object) << place.transpose();
      const auto known = alone.emplace(object->id, object->position_in_enu.mean).first;
      EXPECT_LT((known->second - object->position_in_enu.mean).norm(), 2e-3) << place.transpose();
    }
    EXPECT_EQ(alone.size(), kHere.size());
  }
}

/// What the noise of the first seconds makes of a few looks must not keep the rest from being found.
TEST(ManyObjects, AreAllFoundByANoisyDetector) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise_px(0.0, 1.0);
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector2d& place : grid(-8.0, kFar_m, 4.0)) places.emplace_back(place.x(), place.y(), 0.0);
  NadirFlight flight(GeolocatorConfig{}, out_and_back);
  for (double time_s = 0.5; time_s < kBack_s; time_s += 0.1)
    flight.see_points(time_s, places, [&] { return noise_px(random); });
  for (const Eigen::Vector3d& place : places)
    EXPECT_TRUE(testing::object_at(place.head<2>(), flight.tracks(), 0.5)) << place.transpose();
}

/// Objects that sleep and wake are in the output throughout, each once and in the order of the ids.
TEST(ManyObjects, StayInTheOutputInOrder) {
  NadirFlight flight(GeolocatorConfig{}, out_and_back);
  std::size_t most = 0;
  for (double time_s = 0.5; time_s < kBack_s; time_s += 0.1) {
    flight.see(time_s, everywhere());
    const std::vector<Track>& tracks = flight.tracks();
    const auto is_after = [](const Track& a, const Track& b) { return a.id >= b.id; };
    ASSERT_EQ(std::adjacent_find(tracks.begin(), tracks.end(), is_after), tracks.end()) << time_s;
    ASSERT_GE(tracks.size() + 2, most) << time_s;
    most = std::max(most, tracks.size());
  }
  EXPECT_EQ(flight.tracks().size(), everywhere().size());
}

/// The third time over what is known, though hundreds of objects fall asleep and wake: what each visit adds
/// to what is known of them takes a block now and then.
TEST(ManyObjects, TakeMemoryInFewBlocks) {
  NadirFlight flight(GeolocatorConfig{}, out_and_back);
  double time_s = 0.5;
  for (; time_s < kBack_s + kAway_s; time_s += 0.1) flight.see(time_s, everywhere());
  std::vector<FrameDetections> frames;
  for (; time_s < kBack_s + 2.0 * kAway_s; time_s += 0.1) {
    FrameDetections frame;
    frame.captured_at = testing::at_s(time_s);
    frame.captured_at_host = testing::host_at_s(time_s);
    frame.time_sigma_s = 1e-9;
    for (const Eigen::Vector2d& place : everywhere()) {
      if (const auto pixel = flight.shown(time_s, place)) frame.detections.push_back(testing::box_at(*pixel));
    }
    frames.push_back(frame);
  }
  const std::uint64_t created = flight.geolocator().track_counters().created;
  const std::size_t before = testing::allocations();
  for (const FrameDetections& frame : frames) {
    flight.fly_until(seconds(frame.captured_at.time_since_epoch()));
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  EXPECT_LE(testing::allocations() - before, 12U);
  EXPECT_EQ(flight.geolocator().track_counters().created, created);
}

}  // namespace
}  // namespace geoloc
