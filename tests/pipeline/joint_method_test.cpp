// SPDX-License-Identifier: Apache-2.0
// What the joint method promises of objects that stand still, seen from outside.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/nadir_flight.hpp"
#include "support/wandering.hpp"

namespace geoloc {
namespace {

using testing::box_at;
using testing::geodetic_of;
using testing::hovering_at;
using testing::kFocal_px;
using testing::log_odds;
using testing::NadirFlight;
using testing::northwards;
using testing::Pose;

constexpr double kHeight_m = 20.0;
const Eigen::Vector2d kPlace{2.0, 1.0};

/// Odds of 3 to 7 at birth.
const double kLogOddsAtBirth = std::log(0.3 / 0.7);
/// What one look can say for an object, at most.
constexpr double kMostOfALook = 6.0;

NadirFlight hovering(const GeolocatorConfig& config = {}) {
  return {config, hovering_at({0.0, 0.0, kHeight_m})};
}

const Track& only_track(const NadirFlight& flight) {
  EXPECT_EQ(flight.tracks().size(), 1U);
  return flight.tracks().front();
}

// --- Life cycle: Bayes' rule by hand.

TEST(JointLifeCycle, AnObjectSeenThriceIsConfirmed) {
  NadirFlight flight = hovering();
  for (int look = 0; look < 3; ++look) {
    flight.see(0.5 + 0.5 * look, {kPlace});
    const Track& track = only_track(flight);
    EXPECT_NEAR(log_odds(track), kLogOddsAtBirth + kMostOfALook * look, 1e-9);
    EXPECT_EQ(track.status == TrackStatus::kConfirmed, *track.existence >= 0.999);
    EXPECT_EQ(track.hits, look + 1);
  }
  EXPECT_EQ(only_track(flight).status, TrackStatus::kConfirmed);
  EXPECT_LT((only_track(flight).position_in_enu.mean - kPlace).norm(), 1e-4);
  EXPECT_EQ(only_track(flight).first_seen, testing::host_at_s(0.5));
  EXPECT_EQ(only_track(flight).last_seen, testing::host_at_s(1.5));
}

TEST(JointLifeCycle, AMissCountsAgainstAnObjectUntilItIsDeleted) {
  NadirFlight flight = hovering();
  flight.see(0.5, {kPlace});
  flight.see(1.0, {});
  EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth + std::log(1.0 - 0.9), 1e-9);
  flight.see(1.5, {});  // odds of 0.0043: less than one to a hundred
  EXPECT_TRUE(flight.tracks().empty());
  EXPECT_EQ(flight.geolocator().track_counters().removed, 1U);
  flight.see(2.0, {kPlace});
  EXPECT_EQ(only_track(flight).id, 2U);  // never used again
}

TEST(JointLifeCycle, WhatIsJustAsProbableAsItMustBeIsNotDeleted) {
  GeolocatorConfig config;
  config.joint.birth_probability = config.joint.delete_probability = 0.5;
  NadirFlight flight = hovering(config);
  flight.see(0.5, {kPlace});
  EXPECT_EQ(only_track(flight).existence, 0.5);
  flight.see(1.0, {});
  EXPECT_TRUE(flight.tracks().empty());
}

TEST(JointLifeCycle, ALookMakesGoodForAMiss) {
  NadirFlight flight = hovering();
  flight.see(0.5, {kPlace});
  flight.see(1.0, {});
  flight.see(1.5, {kPlace});
  EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth + std::log(0.1) + kMostOfALook, 1e-9);
}

TEST(JointLifeCycle, WhatIsOutOfTheImageIsNotMissed) {
  NadirFlight flight({}, northwards(20.0));
  const Eigen::Vector2d place(0.0, 10.0);
  flight.see(0.5, {place});
  for (double time_s = 1.5; time_s < 6.0; time_s += 0.5) flight.see(time_s, {});
  EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth, 1e-9);
}

TEST(JointLifeCycle, WhatIsTooSmallToBeFoundIsNotMissed) {
  NadirFlight flight = hovering();
  flight.see(0.5, {kPlace}, 6.0);
  flight.see(1.0, {});
  EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth, 1e-9);
  NadirFlight larger = hovering();
  larger.see(0.5, {kPlace}, 9.0);  // half visible
  larger.see(1.0, {});
  EXPECT_NEAR(log_odds(only_track(larger)), kLogOddsAtBirth + std::log(1.0 - 0.5 * 0.9), 1e-6);
}

/// The detection probability is the share of frames that found a confirmed object, where 18 of 20 stand for
/// what was assumed.
TEST(JointLifeCycle, WhatAMissSaysFollowsHowOftenConfirmedObjectsAreFound) {
  NadirFlight flight = hovering();
  double time_s = 0.5;
  const auto look = [&](bool is_found) {
    flight.see(time_s, is_found ? std::vector<Eigen::Vector2d>{kPlace} : std::vector<Eigen::Vector2d>{});
    time_s += 0.5;
  };
  for (int frame = 0; frame < 3 + 10; ++frame) look(true);            // confirmed by the third
  double found = 18.0 + 10.0, frames = 20.0 + 10.0, expected = 16.0;  // the most that is believed
  for (int miss = 0; miss < 4; ++miss) {
    look(false);
    expected += std::log(1.0 - found / frames);
    frames += 1.0;
    EXPECT_NEAR(log_odds(only_track(flight)), expected, 1e-5);
  }
  while (!flight.tracks().empty()) {
    look(false);
    expected += std::log(1.0 - found / frames);
    frames += 1.0;
    ASSERT_EQ(flight.tracks().empty(), expected < std::log(0.01 / 0.99)) << expected;
  }
}

TEST(JointLifeCycle, ALookIsWeighedAgainstClutter) {
  GeolocatorConfig config;
  config.joint.clutter_per_frame = 500.0;
  config.joint.fast_share = 0.0;
  config.joint.sigma_attitude_deg = 1e-3;
  NadirFlight flight = hovering(config);
  for (double time_s : {0.5, 1.0}) flight.see(time_s, {kPlace});
  // Two looks with the detector's noise each, at the same place: the density of their difference at 0.
  const double ground_per_pixel_m = kHeight_m / kFocal_px;
  const double variance = 2.0 * std::pow(1.5 * ground_per_pixel_m, 2);
  const double density = 1.0 / (2.0 * kPi * variance);
  // What is assumed counts as 50 frames; in these two nothing was false.
  const double clutter = 500.0 * 50.0 / 52.0 / (1280.0 * 720.0 * ground_per_pixel_m * ground_per_pixel_m);
  EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth + std::log(0.9 * density / clutter), 0.02);
}

TEST(JointLifeCycle, ThereAreNeverMoreTracksThanMayBe) {
  GeolocatorConfig config;
  config.joint.max_tracks = 2;
  NadirFlight flight = hovering(config);
  flight.see(0.5, {{-3.0, 0.0}, {0.0, 0.0}, {3.0, 0.0}, {6.0, 0.0}});
  EXPECT_EQ(flight.tracks().size(), 2U);
  EXPECT_EQ(flight.geolocator().track_counters().refused, 2U);
  EXPECT_EQ(flight.geolocator().track_counters().created, 2U);
}

// --- What is no longer believed.

/// Confirmed, and then missed until it is as good as gone.
class JointRetraction : public ::testing::Test {
 protected:
  JointRetraction() {
    for (int frame = 0; frame < 40; ++frame) see({kPlace});
    EXPECT_EQ(only_track(flight_).status, TrackStatus::kConfirmed);
  }

  void see(const std::vector<Eigen::Vector2d>& places) {
    flight_.see(time_s_, places);
    time_s_ += 0.1;
  }

  void miss_until_retracted() {
    while (only_track(flight_).existence >= 0.5) {
      EXPECT_EQ(only_track(flight_).status, TrackStatus::kConfirmed);
      see({});
      ASSERT_FALSE(flight_.tracks().empty());
    }
  }

  NadirFlight flight_ = hovering();
  double time_s_ = 0.5;
};

TEST_F(JointRetraction, IsOfWhatExistsLessProbablyThanNot) {
  miss_until_retracted();
  EXPECT_EQ(only_track(flight_).status, TrackStatus::kTentative);
  EXPECT_EQ(flight_.geolocator().track_counters().removed, 0U);
}

/// It is the same object as before, with all that was known of it.
TEST_F(JointRetraction, EndsWhereTheObjectIsConfirmedAnew) {
  const std::uint64_t id = only_track(flight_).id;
  for (int round = 0; round < 3; ++round) {
    miss_until_retracted();
    while (only_track(flight_).existence < 0.999) {
      EXPECT_EQ(only_track(flight_).status, TrackStatus::kTentative);
      see({kPlace});
    }
    EXPECT_EQ(only_track(flight_).status, TrackStatus::kConfirmed);
    EXPECT_EQ(only_track(flight_).id, id);
    EXPECT_GT(only_track(flight_).hits, 40);
  }
}

/// That an object is gone does not make the detector a worse one: what is new is as probable as before.
TEST_F(JointRetraction, OfWhatWasConfirmedOnceCountsNoFalseBoxes) {
  while (!flight_.tracks().empty()) see({});
  see({kPlace});
  EXPECT_NEAR(log_odds(only_track(flight_)), kLogOddsAtBirth, 1e-9);
}

/// What never was confirmed was false boxes: of ten times as many, a tenth are new objects, by their odds.
TEST(JointClutter, MakesWhatIsNewLessProbable) {
  NadirFlight flight = hovering();
  double time_s = 0.5, frames = 50.0, boxes = 5.0;  // a tenth of a box a frame, as is assumed
  const auto see = [&](const std::vector<Eigen::Vector2d>& places) {
    flight.see(time_s, places);
    time_s += 0.5;
    frames += 1.0;
  };
  for (int round = 0; round < 20; ++round) {
    see({kPlace});
    const double odds = std::min(1.0, 0.1 / (boxes / frames));
    EXPECT_NEAR(log_odds(only_track(flight)), kLogOddsAtBirth + std::log(odds), 1e-9) << round;
    while (!flight.tracks().empty()) see({});
    boxes += 1.0;
  }
  EXPECT_GT(boxes / frames, 0.15);
}

/// The vehicle's position jumps by more than a shaken frame explains, less than two objects could be apart:
/// what is seen beside a confirmed object is a new track at first, and may be the same object.
TEST(JointLifeCycle, AConfirmedObjectIsNotMissedWhileAYoungTrackMayBeTheSame) {
  GeolocatorConfig config;
  config.joint.sigma_attitude_deg = 0.1;
  config.joint.horizontal_accuracy_m = 0.3;
  NadirFlight flight = hovering(config);
  double time_s = 0.5;
  for (; time_s < 20.0; time_s += 0.5) flight.see(time_s, {kPlace});
  const std::vector<Eigen::Vector2d> moved{kPlace + Eigen::Vector2d(1.3, 0.0)};
  flight.see(time_s, moved);
  ASSERT_EQ(flight.tracks().size(), 2U);
  const Track once = flight.tracks()[0];
  flight.see(time_s + 0.5, moved);
  ASSERT_EQ(flight.tracks().size(), 2U);
  EXPECT_EQ(flight.tracks()[0].existence, once.existence);
  EXPECT_EQ(flight.tracks()[1].hits, 2);
}

// --- Which look shows which object.

/// A look of the second frame, so far from the first frame's only one: whether both show the same object, by
/// the noise that look and track have of their own, and that of the second frame, which may be shaken.
bool is_the_same(double distance_m, double penalty) {
  const JointTrackerConfig joint;
  const double ground_per_pixel_m = kHeight_m / kFocal_px;
  const double pixel = std::pow(joint.sigma_px * ground_per_pixel_m, 2);
  const double attitude = std::pow(joint.sigma_attitude_deg * kPi / 180.0 * kHeight_m, 2);
  const double position = std::pow(joint.fast_share * joint.horizontal_accuracy_m, 2) / 2.0;
  const double own = 2.0 * pixel + attitude + position;
  const double calm = own + attitude + position, shaken = own + 16.0 * (attitude + position);
  const double image_m2 = 1280.0 * 720.0 * ground_per_pixel_m * ground_per_pixel_m;
  const double of_something_new = 2.0 * std::log(image_m2 / (2.0 * kPi));
  const double if_calm = distance_m * distance_m / calm + penalty;
  const double if_shaken = distance_m * distance_m / shaken + penalty;
  return if_calm < joint.gate ||
         (if_shaken < joint.gate && if_shaken + 2.0 * std::log(shaken) + 6.0 - 4.6 < of_something_new);
}

double reach_m(double penalty) {
  double reach = 0.0;
  while (is_the_same(reach, penalty)) reach += 1e-3;
  return reach;
}

TEST(JointAssociationReach, EndsWhereSomethingNewIsTheBetterExplanation) {
  for (const Eigen::Vector2d& direction :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(-0.6, 0.8)}) {
    for (const double share : {0.2, 0.6, 0.93, 1.07, 1.5}) {
      NadirFlight flight = hovering();
      flight.see(0.5, {{0.0, 0.0}});
      flight.see(2.5, {share * reach_m(0.0) * direction});
      EXPECT_EQ(flight.tracks().size(), share < 1.0 ? 1U : 2U) << share;
    }
  }
}

TEST(JointAssociationReach, OfADetectorThatKnowsLessIsFarther) {
  NadirFlight flight = hovering();
  flight.see(0.5, {{0.0, 0.0}});
  Detection vague = box_at(*flight.shown(2.5, {1.2, 0.0}));
  vague.sigma_px = 25.0;
  flight.process(2.5, {vague});
  EXPECT_EQ(flight.tracks().size(), 1U);
}

TEST(JointAssociationClasses, ALookOfAnotherClassIsFartherByTheCostOfAMismatch) {
  const auto tracks_after = [&](double distance_m, int class_id, double cost) {
    GeolocatorConfig config;
    config.joint.class_mismatch_cost = cost;
    NadirFlight flight = hovering(config);
    flight.see(0.5, {{0.0, 0.0}}, 36.0, 3);
    flight.see(2.5, {{distance_m, 0.0}}, 36.0, class_id);
    return flight.tracks().size();
  };
  const double of_the_same_m = reach_m(0.0), of_another_m = reach_m(4.0);
  ASSERT_LT(of_another_m, 0.85 * of_the_same_m);
  EXPECT_EQ(tracks_after(0.93 * of_the_same_m, 3, 4.0), 1U);
  EXPECT_EQ(tracks_after(0.93 * of_the_same_m, 5, 4.0), 2U);
  EXPECT_EQ(tracks_after(1.07 * of_another_m, 5, 4.0), 2U);
  EXPECT_EQ(tracks_after(0.93 * of_another_m, 5, 4.0), 1U);
  EXPECT_EQ(tracks_after(0.0, 5, 4.0), 1U);
  EXPECT_EQ(tracks_after(0.0, 5, 12.0), 2U);
  EXPECT_EQ(tracks_after(0.93 * of_the_same_m, 5, 0.0), 1U);
}

/// Two boxes of one class nearer than 0.3 of their size are one object.
TEST(JointDuplicates, AreNotTwoObjects) {
  const auto seen = [](double apart_px, double size_px, double other_size_px, int other_class) {
    NadirFlight flight = hovering();
    const Eigen::Vector2d pixel = *flight.shown(0.5, kPlace);
    flight.process(0.5, {box_at(pixel, size_px),
                         box_at(pixel + Eigen::Vector2d(0.6, 0.8) * apart_px, other_size_px, other_class)});
    return flight.tracks().size();
  };
  EXPECT_EQ(seen(0.28 * 40.0, 40.0, 40.0, 0), 1U);
  EXPECT_EQ(seen(0.32 * 40.0, 40.0, 40.0, 0), 2U);
  EXPECT_EQ(seen(0.28 * 40.0, 40.0, 40.0, 1), 2U);
  EXPECT_EQ(seen(0.28 * 40.0, 40.0, 30.0, 0), 2U);  // the smaller one counts
  EXPECT_EQ(seen(0.28 * 40.0, 30.0, 40.0, 0), 2U);
}

TEST(JointDuplicates, TheMoreConfidentBoxStands) {
  NadirFlight flight = hovering();
  const Eigen::Vector2d pixel = *flight.shown(0.5, kPlace);
  Detection worse = box_at(pixel + Eigen::Vector2d(5.0, 0.0));
  worse.confidence = 0.5;
  flight.process(0.5, {worse, box_at(pixel)});
  EXPECT_LT((only_track(flight).position_in_enu.mean - kPlace).norm(), 1e-4);
  EXPECT_EQ(only_track(flight).hits, 1);
}

// --- Objects begun twice.

/// Looks of two classes by turns, that must not match: two tracks of one object until they are compared.
TEST(JointMerging, TwoTracksOfOneObjectBecomeOne) {
  GeolocatorConfig config;
  config.joint.class_mismatch_cost = 1000.0;
  NadirFlight flight = hovering(config);
  for (int frame = 0; frame < 5; ++frame) {
    flight.see(0.5 + 0.1 * frame, {kPlace}, 36.0, frame % 2);
    EXPECT_EQ(flight.tracks().size(), frame == 0 ? 1U : 2U) << frame;
  }
  flight.see(1.0, {kPlace}, 36.0, 1);
  EXPECT_EQ(only_track(flight).id, 1U);
  EXPECT_EQ(only_track(flight).hits, 6);
  EXPECT_EQ(flight.geolocator().track_counters().merged, 1U);
}

TEST(JointMerging, TwoTracksFartherApartThanTheRadiusStayTwo) {
  GeolocatorConfig config;
  config.joint.class_mismatch_cost = 1000.0;
  config.joint.merge_radius_m = 0.1;
  NadirFlight flight = hovering(config);
  for (int frame = 0; frame < 30; ++frame)
    flight.see(0.5 + 0.1 * frame, {kPlace + Eigen::Vector2d(0.15 * (frame % 2), 0.0)}, 36.0, frame % 2);
  EXPECT_EQ(flight.tracks().size(), 2U);
}

TEST(JointMerging, TwoTracksSeenSideBySideStayTwo) {
  GeolocatorConfig config;
  config.joint.class_mismatch_cost = 1000.0;
  NadirFlight flight = hovering(config);
  for (int frame = 0; frame < 30; ++frame) {
    const Eigen::Vector2d pixel = *flight.shown(0.5 + 0.1 * frame, kPlace);
    flight.process(0.5 + 0.1 * frame,
                   {box_at(pixel, 36.0, 0), box_at(pixel + Eigen::Vector2d(1, 0), 36.0, 1)});
  }
  EXPECT_EQ(flight.tracks().size(), 2U);
}

// --- Errors that all looks share.

std::vector<Eigen::Vector2d> grid(double north_from_m, double north_to_m, double step_m) {
  std::vector<Eigen::Vector2d> places;
  for (double north = north_from_m; north <= north_to_m; north += step_m) {
    for (const double east : {-8.0, 0.0, 7.0}) places.emplace_back(east, north);
  }
  return places;
}

TEST(JointCalibration, OfTheCameraBeginsAsThePriorAndTheAutopilotsOwnErrors) {
  GeolocatorConfig config;
  CalibrationPrior& prior = config.joint.prior;
  prior.boresight_x_deg = 0.3;
  prior.boresight_y_deg = -0.2;
  prior.boresight_z_deg = 1.0;
  prior.latency_s = 0.12;
  prior.height_m = 0.5;
  prior.sigma_boresight_x_deg = 1.0;
  prior.sigma_boresight_y_deg = 2.0;
  prior.sigma_boresight_z_deg = 3.0;
  prior.sigma_latency_s = 0.04;
  prior.sigma_height_m = 0.7;
  prior.position_lag_s = 0.02;
  prior.sigma_position_lag_s = 0.01;
  prior.focal_percent = -4.0;
  prior.sigma_focal_percent = 2.0;
  config.joint.sigma_attitude_bias_deg = 0.9;
  config.joint.sigma_state_lag_s = 0.03;
  const Calibration calibration = *Geolocator(config).calibration();
  constexpr double kDegree = kPi / 180.0;
  CalibrationVector mean, sigma;
  const double offset = std::sqrt(0.5 * config.joint.constant_share) * config.joint.horizontal_accuracy_m;
  mean << 0.3 * kDegree, -0.2 * kDegree, 1.0 * kDegree, 0.12, 0.5, std::log(0.96), 0.02, 0.0, 0.0;
  constexpr double kFoundFocal = 0.006;  // docs/method.md: what an estimate of it is off by besides
  sigma << std::hypot(1.0, 0.9) * kDegree, std::hypot(2.0, 0.9) * kDegree, std::hypot(3.0, 0.9) * kDegree,
      std::hypot(0.04, 0.03), 0.7 / std::sqrt(2.0), std::hypot(0.02 / 0.96, kFoundFocal),
      std::hypot(0.01, 0.03), offset,
      offset;  // the height's is a Cauchy distribution
  EXPECT_LT((calibration.mean - mean).norm(), 1e-12);
  for (int i = 0; i < CalibrationIndex::kSize; ++i) EXPECT_NEAR(calibration.sigma(i), sigma[i], 1e-12) << i;
}

TEST(JointCalibration, FramesAreLocatedWithWhatIsKnownOfTheErrors) {
  GeolocatorConfig config;
  config.joint.prior.latency_s = 0.2;
  config.joint.prior.height_m = 1.0;
  config.joint.prior.boresight_z_deg = 2.0;
  NadirFlight flight(config, northwards(5.0));
  flight.process(3.0, {box_at({kFocal_px + 639.5, 359.5})});  // one height to the right: 45 degrees
  EXPECT_EQ(flight.geolocator().view().vehicle.time, testing::at_s(2.8));
  ASSERT_TRUE(flight.geolocator().located().empty());  // outside of the image
  flight.process(3.2, {box_at({0.5 * kFocal_px + 639.5, 359.5})});
  ASSERT_EQ(flight.geolocator().located().size(), 1U);
  const double turn = 2.0 * kPi / 180.0;
  const Eigen::Vector2d expected(0.5 * 21.0 * std::cos(turn), 15.0 - 0.5 * 21.0 * std::sin(turn));
  EXPECT_LT((flight.geolocator().located()[0].fix.position_in_enu - expected).norm(), 1e-3);
}

/// Sigma of the boresight about the camera's right axis after ten seconds above objects in a circle around
/// the vehicle, which turns on the spot: that tells the boresight from all that stays when the vehicle turns.
double sigma_of_boresight_rad(int objects, double period_s) {
  GeolocatorConfig config;
  config.joint.sigma_attitude_deg = 1.0;  // so that all else is small beside it
  config.joint.sigma_px = 0.1;
  config.joint.sigma_time_s = 0.0;
  config.joint.fast_share = 0.0;
  NadirFlight flight(config, [](double time_s) {
    return Pose{{0.0, 0.0, kHeight_m}, 0.0, 0.0, 0.5 * time_s};
  });
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < objects; ++i) {
    const double direction = 2.0 * kPi * i / objects;
    places.emplace_back(5.0 * std::cos(direction), 5.0 * std::sin(direction));
  }
  for (double time_s = 1.0; time_s < 11.0; time_s += period_s) flight.see(time_s, places);
  return flight.geolocator().calibration()->sigma(CalibrationIndex::kBoresight);
}

/// The vehicle tells its attitude at once and its place `lag_s` later, over objects up to 60 m to the north.
NadirFlight with_late_positions(double lag_s) {
  const testing::Path reported = [lag_s](double time_s) {
    Pose pose = testing::in_gusts(time_s);
    pose.position = testing::in_gusts(time_s - lag_s).position;
    pose.position.head<2>() -= testing::in_gusts(-lag_s).position.head<2>();
    return pose;
  };
  const testing::Path truth = [lag_s](double time_s) {
    Pose pose = testing::in_gusts(time_s);
    pose.position.head<2>() -= testing::in_gusts(-lag_s).position.head<2>();
    return pose;
  };
  return {GeolocatorConfig{}, reported, truth};
}

/// A frame's latency shows in turns as well, a position's lag in the ground's motion alone.
TEST(JointCalibration, TellsALateFrameFromALatePosition) {
  for (const double lag_s : {-0.05, 0.0, 0.08}) {
    NadirFlight flight = with_late_positions(lag_s);
    for (double time_s = 0.5; time_s < 60.0; time_s += 0.1) flight.see(time_s, grid(-4.0, 44.0, 8.0));
    const Calibration learnt = *flight.geolocator().calibration();
    EXPECT_NEAR(learnt.position_lag_s(), lag_s, 0.012);
    EXPECT_LT(std::abs(learnt.position_lag_s() - lag_s), 3.0 * learnt.sigma(CalibrationIndex::kPositionLag));
    EXPECT_NEAR(learnt.latency_s(), 0.0, 0.01);
  }
}

/// Attitudes far noisier than expected may pull the first height down to the ground, where no look
/// contradicts another; the flight then begins anew.
TEST(JointCalibration, IsNotLostInTheFirstSecondsOfAVehicleWithNoisyAttitudes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto noise_rad = [&] { return 2.0 * kPi / 180.0 * normal(random); };
    const auto starting = [](double time_s) {
      const double since_s = std::max(0.0, time_s - 3.0), accelerating_s = std::min(since_s, 2.0);
      const double north_m = 1.25 * accelerating_s * accelerating_s + 5.0 * (since_s - accelerating_s);
      return Pose{{0.0, north_m, kHeight_m}, 0.0, accelerating_s < 2.0 && since_s > 0.0 ? -0.2 : 0.0, 0.0};
    };
    const auto shaken = [&](double time_s) {
      Pose pose = starting(time_s);
      pose.roll += noise_rad();
      pose.pitch += noise_rad();
      pose.yaw += noise_rad();
      return pose;
    };
    const auto late = [&](double time_s) {
      Pose pose = starting(time_s - 0.12);
      pose.roll += 0.02;
      return pose;
    };
    NadirFlight flight(GeolocatorConfig{}, shaken, late);
    std::vector<Eigen::Vector2d> places{{5.0, 3.0}, {-7.0, 4.0}};
    for (double north = 10.0; north < 200.0; north += 4.0) places.emplace_back(8.0 * normal(random), north);
    for (double time_s = 0.5; time_s < 40.0; time_s += 0.1) flight.see(time_s, places);
    const Calibration learnt = *flight.geolocator().calibration();
    EXPECT_LT(std::abs(learnt.height_m()), 5.0) << seed;
    EXPECT_LT(std::abs(learnt.latency_s()), 0.3) << seed;
  }
}

/// All looks of a frame share its attitude: the boresight is known no better for seeing many objects.
TEST(JointCalibration, ManyObjectsInAFrameAreNotAsManyWitnessesOfItsAttitude) {
  const double prior = JointTrackerConfig{}.prior.sigma_boresight_x_deg * kPi / 180.0;
  const double few = sigma_of_boresight_rad(4, 0.2), many = sigma_of_boresight_rad(16, 0.2);
  EXPECT_LT(few, 0.5 * prior);
  EXPECT_NEAR(many / few, 1.0, 0.1);
}

/// Frames within the attitude's time constant share its noise: four times as many say no more.
TEST(JointCalibration, ManyFramesASecondAreNotAsManyWitnessesEither) {
  EXPECT_NEAR(sigma_of_boresight_rad(6, 0.05) / sigma_of_boresight_rad(6, 0.2), 1.0, 0.1);
}

/// The vehicle is not where it reports to be, by a process of known strength; back and forth over objects.
double learnt_strength(double strength, unsigned seed, double duration_s = 180.0,
                       const DriftConfig& process = {}, bool tells_accuracy = true) {
  const JointTrackerConfig joint;
  const double prior_m = std::sqrt(0.5 * (1.0 - joint.constant_share)) * joint.horizontal_accuracy_m;
  const double sigma_m = strength * prior_m, step_s = 0.1;
  std::mt19937 random(seed);
  testing::WanderingPosition wandering(process, sigma_m, step_s);
  std::vector<Eigen::Vector2d> wandered;
  for (int i = 0; i <= 2000; ++i) wandered.push_back(wandering.next(random));
  const testing::Path reported = [](double time_s) {
    const double turned = std::fmod(time_s, 20.0);
    return Pose{{0.0, 3.0 * (turned < 10.0 ? turned : 20.0 - turned), kHeight_m}, 0.0, 0.0, 0.0};
  };
  const testing::Path truth = [&](double time_s) {
    Pose pose = reported(time_s);
    pose.position.head<2>() += wandered[static_cast<std::size_t>(std::lround(time_s / step_s))];
    return pose;
  };
  GeolocatorConfig config;
  config.joint.least_offset_sigma_m = 0.0;
  NadirFlight flight(config, reported, truth);
  if (tells_accuracy) flight.set_accuracy(joint.horizontal_accuracy_m);
  for (int i = 5; step_s * i < duration_s; i += 4) flight.see(step_s * i, grid(0.0, 30.0, 10.0));
  const double constant_m = std::sqrt(0.5 * joint.constant_share) * joint.horizontal_accuracy_m;
  return flight.geolocator().calibration()->sigma(CalibrationIndex::kOffset) / constant_m;
}

TEST(JointCalibration, LearnsHowStronglyThePositionWanders) {
  for (const double strength : {0.4, 1.0})
    EXPECT_NEAR(learnt_strength(strength, 3), strength, 0.3 * strength);
}

/// What wanders twice as much as expected also does between two nodes, which the noise of a second does not
/// hold: it is believed to wander more than it does, and never less.
TEST(JointCalibration, BelievesWhatWandersMoreThanExpectedToDoSoAtLeast) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    EXPECT_GT(learnt_strength(2.0, seed), 1.4);
    EXPECT_LE(learnt_strength(2.0, seed), 3.0 + 1e-6);
  }
}

/// By less than 150 solutions.
TEST(JointCalibration, LearnsTheWanderingInTheFirstMinute) {
  EXPECT_LT(learnt_strength(0.0, 3, 60.0), 0.6);
}

/// The offset's sigma follows the wandering between a tenth and three times what the receiver claims.
TEST(JointCalibration, BelievesTheWanderingWithinBounds) {
  EXPECT_NEAR(learnt_strength(0.0, 3), 0.1, 1e-6);
  DriftConfig without_ripple;  // six times as strong, it would displace looks by more than the gate
  without_ripple.ripple_share = 0.0;
  without_ripple.position_time_constant_s = 30.0;
  EXPECT_NEAR(learnt_strength(6.0, 3, 180.0, without_ripple), 3.0, 1e-6);
}

/// A receiver that claims nothing is as good as the flight shows.
TEST(JointCalibration, BelievesAReceiverThatClaimsNothingToBeAsGoodAsTheFlightShows) {
  EXPECT_LT(learnt_strength(0.0, 3, 180.0, {}, false), 0.05);
}

/// Half of the constant share of the receiver's variance per axis, as it claims it to be now.
TEST(JointCalibration, ExpectsOfTheReceiverWhatItClaims) {
  const auto sigma_after = [](std::optional<double> accuracy_m) {
    NadirFlight flight = hovering();
    flight.set_accuracy(accuracy_m);
    flight.see(0.5, {kPlace});
    return flight.geolocator().calibration()->sigma(CalibrationIndex::kOffset);
  };
  const JointTrackerConfig joint;
  const double share = std::sqrt(0.5 * joint.constant_share);
  EXPECT_NEAR(sigma_after(std::nullopt), share * joint.horizontal_accuracy_m, 1e-6);
  EXPECT_NEAR(sigma_after(3.0), share * 3.0, 1e-6);
  EXPECT_NEAR(sigma_after(1e6), share * 100.0, 1e-4);
  EXPECT_NEAR(sigma_after(1e-6), joint.stated_offset_sigma_m, 1e-9);
}

// --- Known points.

/// The vehicle reports to be where it is not, always by the same.
NadirFlight displaced(const GeolocatorConfig& config, const Eigen::Vector2d& offset) {
  const testing::Path reported = northwards(2.0);
  return {config, reported, [=](double time_s) {
            Pose pose = reported(time_s);
            pose.position.head<2>() += offset;
            return pose;
          }};
}

double farthest_from(const std::vector<Eigen::Vector2d>& places, const NadirFlight& flight) {
  double farthest = 0.0;
  for (const Track& track : flight.tracks()) {
    double nearest = 1e9;
    for (const Eigen::Vector2d& place : places)
      nearest = std::min(nearest, (track.position_in_enu.mean - place).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(JointKnownPoints, TakeTheConstantErrorOutOfAllObjects) {
  const Eigen::Vector2d offset(0.4, -0.3);
  const std::vector<Eigen::Vector2d> places = grid(0.0, 24.0, 8.0);
  for (const bool is_known : {false, true}) {
    GeolocatorConfig config;
    KnownPoint point;
    point.position = geodetic_of(places[4]);
    if (is_known) config.known_points.push_back(point);
    NadirFlight flight = displaced(config, offset);
    for (double time_s = 1.0; time_s < 11.0; time_s += 0.1) flight.see(time_s, places);
    ASSERT_EQ(flight.tracks().size(), places.size());
    if (!is_known) {
      EXPECT_NEAR(farthest_from(places, flight), offset.norm(), 0.02);
      continue;
    }
    EXPECT_LT(farthest_from(places, flight), 0.05);
    ASSERT_EQ(flight.geolocator().known_points().size(), 1U);
    const KnownPointMatch& entry = flight.geolocator().known_points()[0];
    EXPECT_EQ(entry.status, KnownPointStatus::kMatched);
    for (const Track& track : flight.tracks()) {
      const double sigma_m = std::sqrt(0.5 * track.position_in_enu.covariance.trace());
      if (track.id != entry.track_id) continue;
      EXPECT_LT((track.position_in_enu.mean - places[4]).norm(), 0.01);
      // As good as the survey, and hardly better: the looks know nothing of their common error.
      EXPECT_LT(sigma_m, point.sigma_m);
      EXPECT_GT(sigma_m, 0.8 * point.sigma_m);
    }
  }
}

/// What all objects may be off by together, though each is known far better beside the others.
TEST(JointKnownPoints, AreFoundAsFarAsideAsTheReceiverMayBe) {
  const std::vector<Eigen::Vector2d> places = grid(0.0, 24.0, 8.0);
  GeolocatorConfig config;
  config.joint.horizontal_accuracy_m = 1.6;
  KnownPoint point;
  point.position = geodetic_of(places[4]);
  config.known_points = {point};
  NadirFlight flight = displaced(config, {1.0, -0.7});
  for (double time_s = 1.0; time_s < 11.0; time_s += 0.1) flight.see(time_s, places);
  EXPECT_EQ(flight.geolocator().known_points()[0].status, KnownPointStatus::kMatched);
  EXPECT_LT(farthest_from(places, flight), 0.1);
}

/// The frame that matches a point states the covariances that follow. The point's object appears late: the
/// others are known by then but for the receiver's error.
TEST(JointKnownPoints, MakeAllObjectsBetterKnownAtOnce) {
  const std::vector<Eigen::Vector2d> places = grid(0.0, 24.0, 8.0);
  GeolocatorConfig config;
  KnownPoint point;
  point.position = geodetic_of(places[4]);
  config.known_points.push_back(point);
  NadirFlight flight = displaced(config, {0.4, -0.3});
  const auto is_matched = [&] {
    return flight.geolocator().known_points()[0].status == KnownPointStatus::kMatched;
  };
  std::vector<Eigen::Vector2d> others = places;
  others.erase(others.begin() + 4);
  std::vector<Track> before;
  for (double time_s = 1.0; time_s < 11.0 && !is_matched(); time_s += 0.1) {
    before = flight.tracks();
    flight.see(time_s, time_s < 6.0 ? others : places);
  }
  ASSERT_TRUE(is_matched());
  ASSERT_GE(before.size(), 6U);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Track& now = flight.tracks()[i];
    EXPECT_LT(now.position_in_enu.covariance.trace(), 0.6 * before[i].position_in_enu.covariance.trace());
    EXPECT_GT((now.position_in_enu.mean - before[i].position_in_enu.mean).norm(), 0.3);
  }
}

TEST(JointKnownPoints, AreSearchedForAnewWhenTheirObjectIsGone) {
  GeolocatorConfig config;
  KnownPoint point;
  point.position = geodetic_of(kPlace);
  config.known_points.push_back(point);
  NadirFlight flight = hovering(config);
  double time_s = 0.5;
  for (int frame = 0; frame < 40; ++frame, time_s += 0.1) flight.see(time_s, {kPlace});
  ASSERT_EQ(flight.geolocator().known_points()[0].status, KnownPointStatus::kMatched);
  for (int frame = 0; frame < 100; ++frame, time_s += 0.1) flight.see(time_s, {});
  EXPECT_TRUE(flight.tracks().empty());
  EXPECT_NE(flight.geolocator().known_points()[0].status, KnownPointStatus::kMatched);
  for (int frame = 0; frame < 60; ++frame, time_s += 0.1) flight.see(time_s, {kPlace});
  EXPECT_EQ(flight.geolocator().known_points()[0].status, KnownPointStatus::kMatched);
  EXPECT_EQ(flight.geolocator().known_points()[0].track_id, only_track(flight).id);
}

/// Nothing is at the point, and then something is: it takes three looks to be weighed at all, and three
/// solutions to be believed.
TEST(JointKnownPoints, TakeNoNoticeOfWhatWasSeenOnceOrTwice) {
  GeolocatorConfig config;
  KnownPoint point;
  const Eigen::Vector2d place = kPlace + Eigen::Vector2d(-6.0, 0.0);
  point.position = geodetic_of(place);
  config.known_points = {point};
  NadirFlight flight = hovering(config);
  double time_s = 0.5;
  for (int frame = 0; frame < 40; ++frame, time_s += 0.1) flight.see(time_s, {kPlace});
  for (int look = 1; look <= 5; ++look, time_s += 0.1) {
    EXPECT_EQ(flight.geolocator().known_points()[0].status,
              look <= 3 ? KnownPointStatus::kNoObject : KnownPointStatus::kAmbiguous)
        << look;
    flight.see(time_s, {kPlace, place});
    ASSERT_EQ(flight.tracks().size(), 2U);
    EXPECT_EQ(flight.tracks()[1].hits, look);
  }
  EXPECT_EQ(flight.geolocator().known_points()[0].status, KnownPointStatus::kMatched);
}

/// Twenty frames, none of them within a tenth of the image's height of its edge: 72 px, 1.6 m on the ground.
TEST(JointKnownPoints, WaitUntilTheCameraHasLookedWellInsideTheImage) {
  const double half_image_m = 360.0 * kHeight_m / kFocal_px;
  const auto status_at = [&](double from_edge_m) {
    GeolocatorConfig config;
    KnownPoint point;
    point.position = geodetic_of({0.0, half_image_m - from_edge_m});
    config.known_points = {point};
    NadirFlight flight = hovering(config);
    for (int frame = 0; frame < 40; ++frame) flight.see(0.5 + 0.1 * frame, {kPlace});
    return flight.geolocator().known_points()[0].status;
  };
  EXPECT_EQ(status_at(1.45), KnownPointStatus::kNotCovered);
  EXPECT_EQ(status_at(1.7), KnownPointStatus::kNoObject);
}

}  // namespace
}  // namespace geoloc
