// SPDX-License-Identifier: Apache-2.0
// What an elevation model, a rangefinder and surveyed heights promise, seen from outside.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/allocation_counter.hpp"
#include "support/nadir_flight.hpp"
#include "support/tilted_ground.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::noisy_by_the_detector_alone;
using testing::Path;
using testing::Pose;

using Height = double (*)(const Eigen::Vector2d& place);

const LocalFrame kFrame(testing::geodetic_of({0.0, 0.0}), 10.0);

double noiseless() {
  return 0.0;
}

/// 8 m up and down, with slopes up to one in two.
double steep_hills_m(const Eigen::Vector2d& place) {
  return 8.0 * std::sin(place.y() / 15.0 + 0.1 * place.x());
}

/// Down from home by three in five.
double mountainside_m(const Eigen::Vector2d& place) {
  return -0.6 * place.y();
}

std::vector<Eigen::Vector3d> standing_on(Height height_m) {
  std::vector<Eigen::Vector3d> places;
  for (double north = 0.0; north <= 48.0; north += 6.0) {
    for (const double east : {-4.0, 0.5, 5.0}) places.emplace_back(east, north, height_m({east, north}));
  }
  return places;
}

/// To the north, 20 m above what `follow_m` says of the ground, swaying.
Path northwards_over(Height follow_m, double above_m = 20.0) {
  return [=](double time_s) {
    const Eigen::Vector2d place(0.0, 3.0 * time_s);
    return Pose{{place.x(), place.y(), above_m + follow_m(place)},
                0.05 * std::sin(time_s),
                0.05 * std::cos(0.7 * time_s),
                0.0};
  };
}

double level_m(const Eigen::Vector2d&) {
  return 0.0;
}

GeolocatorConfig with_terrain(GeolocatorConfig config, Height height_m) {
  config.terrain = testing::grid_of(
      kFrame, [=](const Eigen::Vector2d& place) { return 500.0 + height_m(place); }, 1.0);
  return config;
}

/// Objects within 5 cm of their places, and all of them; and how far their heights are off at most.
double expect_all_found(const NadirFlight& flight, const std::vector<Eigen::Vector3d>& places) {
  double worst_m = 0.0;
  for (const Eigen::Vector3d& place : places) {
    int found = 0;
    for (const Track& track : flight.tracks()) {
      if ((track.position_in_enu.mean - place.head<2>()).norm() > 0.05) continue;
      ++found;
      worst_m = std::max(worst_m, std::abs(track.height->above_home_m - place.z()));
    }
    EXPECT_EQ(found, 1) << place.transpose();
  }
  EXPECT_EQ(flight.tracks().size(), places.size());
  return worst_m;
}

void fly(NadirFlight& flight, const std::vector<Eigen::Vector3d>& places, double until_s = 19.0) {
  for (double time_s = 0.5; time_s < until_s; time_s += 0.1) flight.see_points(time_s, places, noiseless);
}

// --- An elevation model.

TEST(Terrain, LetsObjectsOnSteepHillsBeFoundWithTheirHeights) {
  const auto places = standing_on(steep_hills_m);
  NadirFlight flight(with_terrain(noisy_by_the_detector_alone(), steep_hills_m),
                     northwards_over(level_m, 25.0));
  fly(flight, places);
  EXPECT_LT(expect_all_found(flight, places), 0.1);
}

/// The vehicle took off at the top, and flies below that.
TEST(Terrain, IsFollowedBelowTheHeightOfHome) {
  const auto places = standing_on(mountainside_m);
  NadirFlight flight(with_terrain({}, mountainside_m), northwards_over(mountainside_m));
  fly(flight, places);
  ASSERT_LT(flight.geolocator().view().vehicle.enu_from_body.translation.z(), -10.0);
  EXPECT_LT(expect_all_found(flight, places), 0.5);
}

/// From one ray, the height is the ground's at its end and as sure.
TEST(Terrain, PlacesWhatWasSeenFromOneSideWhereTheRayEnds) {
  GeolocatorConfig config = with_terrain(noisy_by_the_detector_alone(), mountainside_m);
  config.joint.sigma_ground_m = 0.5;
  NadirFlight flight(config, testing::hovering_at({0.0, 0.0, 20.0}));
  const Eigen::Vector3d place(3.0, 4.0, mountainside_m({3.0, 4.0}));
  for (double time_s = 0.5; time_s < 1.4; time_s += 0.1) flight.see_points(time_s, {place}, noiseless);
  ASSERT_EQ(flight.tracks().size(), 1U);
  const Track& object = flight.tracks()[0];
  EXPECT_LT((object.position_in_enu.mean - place.head<2>()).norm(), 0.01);
  EXPECT_NEAR(object.height->above_home_m, place.z(), 0.01);
  // Along the ray, the ground's sigma is that of a plane which the ray meets obliquely.
  const Eigen::Vector2d ray = place.head<2>() / (place.z() - 20.0);
  const double obliquity = 1.0 - Eigen::Vector2d(0.0, -0.6).dot(ray);
  EXPECT_NEAR(object.height->sigma_m, 0.5 / obliquity, 0.01);
}

TEST(Terrain, IsWhereWhatMovesIsSeen) {
  GeolocatorConfig config = with_terrain(noisy_by_the_detector_alone(), mountainside_m);
  config.joint.moving.classes = {0};
  NadirFlight flight(config, testing::hovering_at({0.0, 0.0, 20.0}));
  const Eigen::Vector3d place(3.0, 4.0, mountainside_m({3.0, 4.0}));
  for (double time_s = 0.5; time_s < 1.4; time_s += 0.1) flight.see_points(time_s, {place}, noiseless);
  ASSERT_EQ(flight.tracks().size(), 1U);
  EXPECT_LT((flight.tracks()[0].position_in_enu.mean - place.head<2>()).norm(), 0.01);
}

TEST(Terrain, IsWhereThePapersRaysEnd) {
  GeolocatorConfig config = with_terrain({}, steep_hills_m);
  config.method = Method::kPaper;
  const auto places = standing_on(steep_hills_m);
  NadirFlight flight(config, northwards_over(level_m, 25.0));
  fly(flight, places);
  ASSERT_EQ(flight.tracks().size(), places.size());
  for (const Eigen::Vector3d& place : places) {
    int found = 0;
    for (const Track& track : flight.tracks())
      found += (track.position_in_enu.mean - place.head<2>()).norm() < 0.05 ? 1 : 0;
    EXPECT_EQ(found, 1) << place.transpose();
  }
}

// --- A rangefinder.

/// Readings ten times a second of a sensor that looks down the body's axis.
void measure(NadirFlight& flight, const Path& truth, double until_s, double wrong_m = 0.0) {
  for (double time_s = 0.0; time_s < until_s; time_s += 0.1) {
    const Pose pose = truth(time_s);
    const double distance_m = pose.position.z() / (std::cos(pose.roll) * std::cos(pose.pitch));
    flight.geolocator().add(RangeSample{testing::at_s(time_s), distance_m + wrong_m});
  }
}

Path too_high_by(double too_high_m, const Path& truth) {
  return [=](double time_s) {
    Pose pose = truth(time_s);
    pose.position.z() += too_high_m;
    return pose;
  };
}

/// A hovering vehicle's looks tell nothing of its height: what it reports is believed, or what it measures.
TEST(Rangefinder, TellsTheHeightThatLooksDoNot) {
  for (const double too_high_m : {-15.0, 6.0}) {
    GeolocatorConfig config;
    config.joint.sigma_ground_m = 0.1;
    const Path truth = testing::hovering_at({0.0, 0.0, 25.0});
    NadirFlight flight(config, too_high_by(too_high_m, truth), truth);
    measure(flight, truth, 6.0);
    for (double time_s = 0.5; time_s < 5.0; time_s += 0.1) flight.see(time_s, {{6.0, 4.0}, {-5.0, 3.0}});
    const auto calibration = flight.geolocator().calibration();
    EXPECT_NEAR(calibration->height_m(), -too_high_m, 1.0);
    EXPECT_LT(calibration->sigma(CalibrationIndex::kHeight), 1.0);
    EXPECT_GT(flight.geolocator().track_counters().ranges_used, 40U);
    EXPECT_EQ(flight.geolocator().track_counters().ranges_refused, 0U);
  }
}

TEST(Rangefinder, ThatDisagreesIsRefusedAndCounted) {
  GeolocatorConfig config;
  config.joint.sigma_ground_m = 0.5;
  const auto places = standing_on(level_m);
  const Path truth = northwards_over(level_m);
  NadirFlight flight(config, truth);
  fly(flight, places, 9.0);
  const double before_m = flight.geolocator().calibration()->height_m();
  for (double time_s = 9.0; time_s < 14.0; time_s += 0.1)
    flight.geolocator().add(RangeSample{testing::at_s(time_s), 35.0});
  for (double time_s = 9.5; time_s < 13.0; time_s += 0.1) flight.see_points(time_s, places, noiseless);
  EXPECT_EQ(flight.geolocator().track_counters().ranges_used, 0U);
  EXPECT_GT(flight.geolocator().track_counters().ranges_refused, 30U);
  EXPECT_NEAR(flight.geolocator().calibration()->height_m(), before_m, 0.1);
}

TEST(Rangefinder, SaysNothingWithNumbersThatCannotBeOrAfterAPause) {
  GeolocatorConfig config;
  NadirFlight flight(config, testing::hovering_at({0.0, 0.0, 20.0}));
  for (const double distance_m : {std::nan(""), -3.0, 0.0, std::numeric_limits<double>::infinity()})
    flight.geolocator().add(RangeSample{testing::at_s(0.5), distance_m});
  EXPECT_EQ(flight.geolocator().counters().ranges, 0U);
  flight.geolocator().add(RangeSample{testing::at_s(0.0), 20.0});
  flight.geolocator().add(RangeSample{testing::at_s(2.0), 20.0});
  flight.see(1.0, {{6.0, 4.0}});
  EXPECT_EQ(flight.geolocator().track_counters().ranges_used, 0U);
}

// --- Surveyed heights.

/// Two marks on a roof and one beside it, seen from one side only: what tells their heights is the survey.
TEST(KnownHeights, AreTheObjectsHeightsAgainstEachOther) {
  const std::vector<Eigen::Vector3d> marks{{-6.0, 2.0, 4.0}, {6.0, 3.0, 4.0}, {1.0, -4.0, -2.0}};
  GeolocatorConfig config;
  for (const Eigen::Vector3d& mark : marks) {
    KnownPoint point;
    point.position = testing::geodetic_of(mark.head<2>());
    point.height_m = 812.0 + mark.z();
    point.sigma_height_m = 0.05;
    config.known_points.push_back(point);
  }
  NadirFlight flight(config, testing::northwards(0.05));
  for (double time_s = 0.5; time_s < 9.0; time_s += 0.1) flight.see_points(time_s, marks, noiseless);
  ASSERT_EQ(flight.tracks().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(flight.geolocator().known_points()[i].status, KnownPointStatus::kMatched);
    const std::uint64_t id = flight.geolocator().known_points()[i].track_id;
    const std::uint64_t first = flight.geolocator().known_points()[0].track_id;
    double height_m = 0.0, first_m = 0.0;
    for (const Track& track : flight.tracks()) {
      if (track.id == id) height_m = track.height->above_home_m;
      if (track.id == first) first_m = track.height->above_home_m;
    }
    EXPECT_NEAR(height_m - first_m, marks[i].z() - marks[0].z(), 0.1);
  }
}

// --- Memory.

TEST(Ground, IsAskedWithoutAllocating) {
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    GeolocatorConfig config = with_terrain({}, steep_hills_m);
    config.method = method;
    config.joint.moving.classes = {3};
    config.joint.drift.max_nodes = 4;
    const Path path = northwards_over(level_m, 25.0);
    const auto places = standing_on(steep_hills_m);
    NadirFlight flight(config, path);
    std::vector<FrameDetections> frames;
    for (double time_s = 0.5; time_s < 15.0; time_s += 0.1) {
      FrameDetections frame;
      frame.captured_at = testing::at_s(time_s);
      frame.captured_at_host = testing::host_at_s(time_s);
      for (const Eigen::Vector3d& place : places) {
        if (const auto pixel = flight.shown_point(time_s, place))
          frame.detections.push_back(testing::box_at(*pixel, 36.0, place.x() > 4.0 ? 3 : 0));
      }
      frames.push_back(std::move(frame));
    }
    flight.fly_until(15.0);
    const std::size_t before = testing::allocations();
    for (double time_s = 0.0; time_s < 15.0; time_s += 0.1)
      flight.geolocator().add(RangeSample{testing::at_s(time_s), 25.0});
    for (const FrameDetections& frame : frames) EXPECT_TRUE(flight.geolocator().process(frame));
    EXPECT_EQ(testing::allocations(), before) << static_cast<int>(method);
    EXPECT_TRUE(method == Method::kPaper || flight.geolocator().track_counters().ranges_used > 5U);
  }
}

}  // namespace
}  // namespace geoloc
