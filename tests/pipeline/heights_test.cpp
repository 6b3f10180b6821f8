// SPDX-License-Identifier: Apache-2.0
// What the joint method promises of heights, seen from outside.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::box_at;
using testing::kFocal_px;
using testing::NadirFlight;
using testing::noisy_by_the_detector_alone;
using testing::Path;
using testing::Pose;

constexpr double kHeight_m = 20.0;

double noiseless() {
  return 0.0;
}

/// A grid on ground that rises and falls.
std::vector<Eigen::Vector3d> on_hills(double amplitude_m) {
  std::vector<Eigen::Vector3d> places;
  for (double north = 0.0; north <= 48.0; north += 6.0) {
    for (const double east : {-7.0, 0.5, 8.0})
      places.emplace_back(east, north, amplitude_m * std::sin(0.1 * north + 0.2 * east));
  }
  return places;
}

/// To the north, rolling and pitching a little.
Path swaying_northwards(double height_m = kHeight_m) {
  return [=](double time_s) {
    return Pose{{0.0, 3.0 * time_s, height_m}, 0.05 * std::sin(time_s), 0.05 * std::cos(0.7 * time_s), 0.0};
  };
}

/// The same, reported to be so much higher than it is.
Path too_high_by(double too_high_m, const Path& truth) {
  return [=](double time_s) {
    Pose pose = truth(time_s);
    pose.position.z() += too_high_m;
    return pose;
  };
}

/// The only confirmed object within a metre of the place; nullptr where there is none, or where there are
/// several.
const Track* object_at(const Eigen::Vector3d& place, const NadirFlight& flight) {
  return testing::object_at(place.head<2>(), flight.tracks(), 1.0);
}

// --- Where objects are.

TEST(JointHeights, OfObjectsOnHillsAreFoundWithTheirPlaces) {
  for (const double amplitude_m : {1.0, 3.0}) {
    const std::vector<Eigen::Vector3d> places = on_hills(amplitude_m);
    NadirFlight flight(noisy_by_the_detector_alone(), swaying_northwards());
    for (double time_s = 0.5; time_s < 19.0; time_s += 0.1) flight.see_points(time_s, places, noiseless);
    ASSERT_EQ(flight.tracks().size(), places.size());
    for (const Eigen::Vector3d& place : places) {
      const Track* const object = object_at(place, flight);
      ASSERT_TRUE(object) << place.transpose();
      EXPECT_LT((object->position_in_enu.mean - place.head<2>()).norm(), 0.02) << place.transpose();
      ASSERT_TRUE(object->height);
      EXPECT_NEAR(object->height->above_home_m, place.z(), 0.05) << place.transpose();
    }
  }
}

/// Nothing but the detector is noisy, and the hills are as high as is expected.
TEST(JointHeights, AreAsFarOffAsTheirSigmaSays) {
  constexpr double kSigma_px = 1.5;
  double sum = 0.0;
  int count = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise_px(0.0, kSigma_px), hill_m(0.0, 0.5);
    GeolocatorConfig config = noisy_by_the_detector_alone();
    config.joint.sigma_ground_m = hill_m.stddev();
    config.joint.sigma_px = kSigma_px;
    std::vector<Eigen::Vector3d> places = on_hills(0.0);
    for (Eigen::Vector3d& place : places) place.z() = hill_m(random);
    NadirFlight flight(config, swaying_northwards());
    for (double time_s = 0.5; time_s < 19.0; time_s += 0.5)
      flight.see_points(time_s, places, [&] { return noise_px(random); });
    for (const Eigen::Vector3d& place : places) {
      const Track* const object = object_at(place, flight);
      ASSERT_TRUE(object) << place.transpose();
      sum += std::pow((object->height->above_home_m - place.z()) / object->height->sigma_m, 2);
      ++count;
    }
  }
  ASSERT_EQ(count, 6 * 27);
  EXPECT_NEAR(sum / count, 1.0, 3.0 * std::sqrt(2.0 / count));  // chi-square over its degrees of freedom
}

/// From a level camera that looks straight down, looks have the same noise on the ground everywhere, and the
/// slopes of their rays are the distances from the vehicle over its height: a straight line is fitted to
/// them. What the detector's noise is, the flight itself has shown, to a few percent.
TEST(JointHeights, HaveTheSigmaOfALineThroughTheLooks) {
  const Eigen::Vector3d place(2.0, 12.0, 0.0);
  GeolocatorConfig config = noisy_by_the_detector_alone();
  std::mt19937 random(1);
  std::normal_distribution<double> noise_px(0.0, config.joint.sigma_px);
  NadirFlight flight(config, testing::northwards(4.0));
  double looks = 0.0, sum = 0.0, sum_of_squares = 0.0;
  for (double time_s = 0.5; time_s < 6.0; time_s += 0.1) {
    if (!flight.shown_point(time_s, place)) continue;
    flight.see_points(time_s, {place}, [&] { return noise_px(random); });
    const double slope = (place.y() - 4.0 * time_s) / kHeight_m;
    looks += 1.0;
    sum += slope;
    sum_of_squares += slope * slope;
  }
  const double variance = std::pow(config.joint.sigma_px * kHeight_m / kFocal_px, 2);
  const double spread = sum_of_squares - sum * sum / looks;
  const double sigma_m = 1.0 / std::sqrt(spread / variance + std::pow(config.joint.sigma_ground_m, -2));
  ASSERT_EQ(flight.tracks().size(), 1U);
  ASSERT_GT(looks, 20.0);
  EXPECT_NEAR(flight.tracks()[0].height->sigma_m, sigma_m, 0.05 * sigma_m);
}

/// An object that was seen along one ray has the ground's height, which home's height is told from by the
/// camera's.
TEST(JointHeights, OfAnObjectSeenFromOneSideAreAsUnsureAsTheGroundAndHome) {
  GeolocatorConfig config;
  NadirFlight flight(config, testing::hovering_at({0.0, 0.0, kHeight_m}));
  for (double time_s = 0.5; time_s < 1.4; time_s += 0.1) flight.see(time_s, {{3.0, 2.0}});
  ASSERT_EQ(flight.tracks().size(), 1U);
  const double home_m = config.joint.prior.sigma_height_m / std::sqrt(2.0);  // in the middle of its tails
  EXPECT_NEAR(flight.tracks()[0].height->sigma_m, std::hypot(config.joint.sigma_ground_m, home_m), 1e-3);
  EXPECT_NEAR(flight.tracks()[0].height->above_home_m, 0.0, 1e-6);
}

/// The ground is 5 m above the place that heights are reported from, and the camera 2 m higher than that
/// says.
TEST(JointHeights, AreAboveTheReportedHome) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.projector.ground_height_above_home_m = 5.0;
  config.joint.prior.height_m = 2.0;
  const Path truth = swaying_northwards(28.0);
  NadirFlight flight(config, too_high_by(-2.0, truth), truth);
  std::vector<Eigen::Vector3d> places = on_hills(2.0);
  for (Eigen::Vector3d& place : places) place.z() += 5.0;
  for (double time_s = 0.5; time_s < 19.0; time_s += 0.1) flight.see_points(time_s, places, noiseless);
  for (const Eigen::Vector3d& place : places) {
    const Track* const object = object_at(place, flight);
    ASSERT_TRUE(object) << place.transpose();
    EXPECT_NEAR(object->height->above_home_m, place.z() - 2.0, 0.05) << place.transpose();
  }
}

TEST(JointHeights, AreAllTheSameWhereTheGroundIsLevel) {
  GeolocatorConfig config;
  config.joint.sigma_ground_m = 0.0;
  const std::vector<Eigen::Vector3d> places = on_hills(0.0);
  NadirFlight flight(config, swaying_northwards());
  for (double time_s = 0.5; time_s < 19.0; time_s += 0.1) flight.see_points(time_s, places, noiseless);
  ASSERT_EQ(flight.tracks().size(), places.size());
  const double home_m = -flight.geolocator().calibration()->height_m();
  const double sigma_m = flight.geolocator().calibration()->sigma(CalibrationIndex::kHeight);
  for (const Track& track : flight.tracks()) {
    EXPECT_NEAR(track.height->above_home_m, home_m, 1e-3);
    EXPECT_NEAR(track.height->sigma_m, sigma_m, 1e-3);
  }
}

TEST(JointHeights, AreNotEstimatedOfWhatMovesOrByThePapersMethod) {
  GeolocatorConfig config;
  config.joint.moving.classes = {2};
  NadirFlight joint(config, testing::hovering_at({0.0, 0.0, kHeight_m}));
  joint.see(0.5, {{3.0, 2.0}}, 36.0, 2);
  joint.see(0.6, {{3.0, 2.0}}, 36.0, 2);
  config.method = Method::kPaper;
  NadirFlight paper(config, testing::hovering_at({0.0, 0.0, kHeight_m}));
  paper.see(0.5, {{3.0, 2.0}});
  for (const NadirFlight* flight : {&joint, &paper}) {
    ASSERT_EQ(flight->tracks().size(), 1U);
    EXPECT_FALSE(flight->tracks()[0].height);
  }
}

// --- A vehicle that took off elsewhere.

/// The vehicle reports heights above a place that is lower or higher than the ground it flies over.
TEST(JointTakeOff, ElsewhereCostsNothing) {
  const std::vector<Eigen::Vector3d> places = on_hills(1.0);
  for (const double too_high_m : {-10.0, -5.0, 0.0, 5.0, 10.0}) {
    SCOPED_TRACE(too_high_m);
    const Path truth = swaying_northwards(30.0);
    NadirFlight flight({}, too_high_by(too_high_m, truth), truth);
    for (double time_s = 0.5; time_s < 19.0; time_s += 0.1) flight.see_points(time_s, places, noiseless);
    for (const Eigen::Vector3d& place : places) {
      const Track* const object = object_at(place, flight);
      ASSERT_TRUE(object) << place.transpose();
      EXPECT_LT((object->position_in_enu.mean - place.head<2>()).norm(), 0.3) << place.transpose();
      EXPECT_NEAR(object->height->above_home_m, place.z() + too_high_m, 0.6) << place.transpose();
    }
    EXPECT_EQ(flight.tracks().size(), places.size());
    EXPECT_NEAR(flight.geolocator().calibration()->height_m(), -too_high_m, 0.3);
  }
}

// --- The opening of a flight.

/// So rare that drift nodes are frozen while the first looks are still linearised anew.
TEST(JointOpening, OfRareFramesEndsWithTheFirstNodes) {
  const std::vector<Eigen::Vector3d> places = on_hills(0.5);
  for (const auto& [max_nodes, period_s] : {std::pair{36, 2.0}, {4, 0.5}, {4, 7.0}}) {
    GeolocatorConfig config = noisy_by_the_detector_alone();
    config.joint.drift.max_nodes = max_nodes;
    const double speed_mps = 0.25 / period_s;
    NadirFlight flight(config, testing::northwards(speed_mps));
    for (int frame = 1; frame < 160; ++frame) flight.see_points(period_s * frame, places, noiseless);
    for (const Eigen::Vector3d& place : places) {
      if (place.y() > 36.0) continue;
      const Track* const object = object_at(place, flight);
      ASSERT_TRUE(object) << place.transpose();
      EXPECT_LT((object->position_in_enu.mean - place.head<2>()).norm(), 0.05) << place.transpose();
    }
  }
}

}  // namespace
}  // namespace geoloc
