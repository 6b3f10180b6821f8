// SPDX-License-Identifier: Apache-2.0
// What the joint method promises of objects that may move, seen from outside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::box_at;
using testing::log_odds;
using testing::NadirFlight;

constexpr int kMovingClass = 2, kOtherMovingClass = 3;
constexpr double kMetresPerPixel = 20.0 / testing::kFocal_px;

/// Nothing but the detector is noisy, and nothing is left to learn.
GeolocatorConfig noisy_by_the_detector_alone() {
  GeolocatorConfig config = testing::noisy_by_the_detector_alone();
  config.joint.moving.classes = {kMovingClass, kOtherMovingClass};
  return config;
}

NadirFlight watching(const GeolocatorConfig& config = noisy_by_the_detector_alone()) {
  return {config, testing::hovering_at({0.0, 0.0, 20.0})};
}

Detection at(const Eigen::Vector2d& place, int class_id = kMovingClass) {
  return box_at(*testing::pixel_of(place, testing::hovering_at({0.0, 0.0, 20.0})(0.0)), 36.0, class_id);
}

/// The textbook's filter of one axis, element by element: position and velocity, white acceleration.
struct AxisFilter {
  double position, velocity = 0.0;
  double pp, pv = 0.0, vv;  // covariance

  AxisFilter(double measured, double variance, double sigma_speed)
      : position(measured), pp(variance), vv(sigma_speed * sigma_speed) {}

  void predict(double t, double sigma_acceleration) {
    const double q = sigma_acceleration * sigma_acceleration;
    position += t * velocity;
    pp += 2.0 * t * pv + t * t * vv + q * t * t * t / 3.0;
    pv += t * vv + q * t * t / 2.0;
    vv += q * t;
  }

  /// The probability density of the measurement, before it is used.
  double update(double measured, double variance) {
    const double innovation = measured - position, s = pp + variance;
    const double gain_p = pp / s, gain_v = pv / s;
    position += gain_p * innovation;
    velocity += gain_v * innovation;
    vv -= gain_v * pv;
    pv -= gain_p * pv;
    pp -= gain_p * pp;
    return std::exp(-0.5 * innovation * innovation / s) / std::sqrt(2.0 * kPi * s);
  }
};

TEST(MovingObjects, AreEstimatedByTheTextbooksKalmanFilter) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.clutter_per_frame = 1000.0;  // so that no look says more than is believed of one
  config.joint.confirm_probability = 1.0 - 1e-9;
  const MovingConfig& moving = config.joint.moving;
  NadirFlight flight = watching(config);
  std::mt19937 random(3);
  std::normal_distribution<double> noise_m(0.0, 1.5 * kMetresPerPixel);
  const double variance = std::pow(1.5 * kMetresPerPixel, 2);
  // Assumed for 50 frames' worth, and none is counted.
  const auto clutter_after = [](double frames) {
    return 1000.0 * 50.0 / (50.0 + frames) / (1280.0 * 720.0 * kMetresPerPixel * kMetresPerPixel);
  };
  double frames = 0.0;
  std::optional<std::array<AxisFilter, 2>> expected;
  double before_s = 0.0, expected_log_odds = std::log(0.3 / 0.7);
  for (const double time_s : {0.5, 0.6, 0.7, 0.8, 1.1, 1.2, 2.0, 2.1, 2.2}) {
    const Eigen::Vector2d measured(-4.0 + 3.0 * time_s + noise_m(random), 2.0 - time_s + noise_m(random));
    flight.process(time_s, {at(measured)});
    frames += 1.0;
    if (!expected) {
      expected.emplace(std::array<AxisFilter, 2>{AxisFilter(measured.x(), variance, moving.sigma_speed_mps),
                                                 AxisFilter(measured.y(), variance, moving.sigma_speed_mps)});
      before_s = time_s;
      continue;
    }
    double density = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      (*expected)[static_cast<std::size_t>(axis)].predict(time_s - before_s, moving.sigma_acceleration_mps2);
      density *= (*expected)[static_cast<std::size_t>(axis)].update(measured[axis], variance);
    }
    before_s = time_s;
    expected_log_odds += std::log(0.9 * density / clutter_after(frames));
    ASSERT_EQ(flight.tracks().size(), 1U);
    const Track& track = flight.tracks()[0];
    ASSERT_TRUE(track.velocity_in_enu);
    for (int axis = 0; axis < 2; ++axis) {
      const AxisFilter& filter = (*expected)[static_cast<std::size_t>(axis)];
      EXPECT_NEAR(track.position_in_enu.mean[axis], filter.position, 1e-4);
      EXPECT_NEAR(track.velocity_in_enu->mean[axis], filter.velocity, 1e-3);
      EXPECT_NEAR(track.position_in_enu.covariance(axis, axis), filter.pp, 1e-3 * filter.pp);
      EXPECT_NEAR(track.velocity_in_enu->covariance(axis, axis), filter.vv, 1e-3 * filter.vv);
    }
    EXPECT_NEAR(log_odds(track), expected_log_odds, 0.01);
  }
}

/// Seen at rest, several times: confirmed.
NadirFlight with_a_confirmed_object(const GeolocatorConfig& config, double& time_s) {
  NadirFlight flight = watching(config);
  for (time_s = 0.5; time_s < 1.55; time_s += 0.1) flight.process(time_s, {at({1.0, 0.0})});
  EXPECT_EQ(flight.tracks().size(), 1U);
  EXPECT_EQ(flight.tracks()[0].status, TrackStatus::kConfirmed);
  time_s -= 0.1;  // of the last look
  return flight;
}

TEST(MovingObjects, AreRecognizedWithinTheirMemoryAndNotBeyond) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.moving.memory_s = 3.0;
  for (const double pause_s : {2.9, 3.1}) {
    double time_s = 0.0;
    NadirFlight flight = with_a_confirmed_object(config, time_s);
    const Track before = flight.tracks()[0];
    flight.process(time_s + pause_s, {at({1.0, 0.0})});
    if (pause_s < 3.0) {
      ASSERT_EQ(flight.tracks().size(), 1U);
      EXPECT_EQ(flight.tracks()[0].hits, before.hits + 1);
      continue;
    }
    ASSERT_EQ(flight.tracks().size(), 2U);  // it stays where it was seen
    EXPECT_EQ(flight.tracks()[0].hits, before.hits);
    EXPECT_EQ(flight.tracks()[0].position_in_enu.mean, before.position_in_enu.mean);
    EXPECT_EQ(flight.tracks()[1].hits, 1);
  }
}

TEST(MovingObjects, ThatAreNotWhereTheyShouldBeStayWhereTheyWereAndAreNotRecognized) {
  double time_s = 0.0;
  NadirFlight flight = with_a_confirmed_object(noisy_by_the_detector_alone(), time_s);
  const Track before = flight.tracks()[0];
  // Each miss takes ln 10 or a little more of the 16 that were believed: the ninth makes it improbable.
  for (int miss = 0; miss < 12; ++miss) flight.process(time_s += 0.1, {});
  ASSERT_EQ(flight.tracks().size(), 1U);
  EXPECT_EQ(flight.tracks()[0].position_in_enu.mean, before.position_in_enu.mean);
  EXPECT_EQ(flight.tracks()[0].status, TrackStatus::kConfirmed);
  EXPECT_GE(*flight.tracks()[0].existence, JointTrackerConfig{}.delete_probability);
  flight.process(time_s += 0.1, {at({1.0, 0.0})});
  EXPECT_EQ(flight.tracks().size(), 2U);
}

TEST(MovingObjects, SeenOnceAndMissedTwiceWereNone) {
  NadirFlight flight = watching();
  flight.process(0.5, {at({1.0, 0.0})});
  EXPECT_FALSE(flight.tracks()[0].velocity_in_enu);
  flight.process(0.6, {});
  ASSERT_EQ(flight.tracks().size(), 1U);
  EXPECT_NEAR(log_odds(flight.tracks()[0]), std::log(0.3 / 0.7) + std::log(1.0 - 0.9), 1e-9);
  flight.process(0.7, {});
  EXPECT_TRUE(flight.tracks().empty());
  EXPECT_EQ(flight.geolocator().track_counters().removed, 1U);
}

TEST(MovingObjects, OutOfTheImageAreNotMissed) {
  NadirFlight flight(noisy_by_the_detector_alone(), testing::northwards(20.0));
  flight.see(0.5, {{0.0, 10.0}}, 36.0, kMovingClass);
  for (double time_s = 2.0; time_s < 5.0; time_s += 0.5) flight.process(time_s, {});
  ASSERT_EQ(flight.tracks().size(), 1U);
  EXPECT_NEAR(log_odds(flight.tracks()[0]), std::log(0.3 / 0.7), 1e-9);
}

/// Looks of two classes by turns that must not match make two tracks, until both are known well enough.
TEST(MovingObjects, BegunTwiceBecomeOne) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.class_mismatch_cost = 1000.0;
  NadirFlight flight = watching(config);
  for (int frame = 0; frame < 6; ++frame) {
    flight.process(0.5 + 0.1 * frame, {at({1.0, 0.0}, frame % 2 == 0 ? kMovingClass : kOtherMovingClass)});
    EXPECT_EQ(flight.tracks().size(), frame == 0 || frame == 5 ? 1U : 2U) << frame;
  }
  EXPECT_EQ(flight.tracks()[0].id, 1U);
  EXPECT_EQ(flight.tracks()[0].hits, 6);
  EXPECT_EQ(flight.geolocator().track_counters().merged, 1U);
}

TEST(MovingObjects, SeenSideBySideStayTwo) {
  NadirFlight flight = watching();
  for (int frame = 0; frame < 12; ++frame) {
    Detection beside = at({1.0, 0.0}, kOtherMovingClass);
    beside.box.x += 1.0;
    flight.process(0.5 + 0.1 * frame, {at({1.0, 0.0}), beside});
  }
  EXPECT_EQ(flight.tracks().size(), 2U);
}

TEST(MovingObjects, ThatPassEachOtherStayTwo) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.class_mismatch_cost = 1000.0;
  NadirFlight flight = watching(config);
  for (int frame = 0; frame < 40; ++frame) {  // by turns, so that no frame shows both
    const double ahead_m = 0.2 * (frame - 20);
    flight.process(0.5 + 0.1 * frame,
                   {frame % 2 == 0 ? at({ahead_m, 0.0}) : at({-ahead_m, 0.0}, kOtherMovingClass)});
  }
  EXPECT_EQ(flight.tracks().size(), 2U);
}

TEST(MovingObjects, OfAnotherClassAreFartherByTheCostOfAMismatch) {
  const auto tracks_after = [](double cost) {
    GeolocatorConfig config = noisy_by_the_detector_alone();
    config.joint.class_mismatch_cost = cost;
    NadirFlight flight = watching(config);
    flight.process(0.5, {at({1.0, 0.0})});
    flight.process(0.6, {at({1.0, 0.0}, kOtherMovingClass)});
    return flight.tracks().size();
  };
  EXPECT_EQ(tracks_after(4.0), 1U);
  EXPECT_EQ(tracks_after(12.0), 2U);
}

TEST(MovingObjects, ShareTheListInOrderOfIdsWithThoseThatDoNotMove) {
  NadirFlight flight = watching();
  flight.process(0.5, {at({-5.0, 0.0}, 0)});
  flight.process(0.6, {at({-5.0, 0.0}, 0), at({0.0, 0.0})});
  flight.process(0.7, {at({-5.0, 0.0}, 0), at({0.0, 0.0}), at({5.0, 0.0}, 0)});
  flight.process(0.8, {at({-5.0, 0.0}, 0), at({0.0, 0.0}), at({5.0, 0.0}, 0), at({0.0, 5.0})});
  ASSERT_EQ(flight.tracks().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(flight.tracks()[i].id, i + 1);
  EXPECT_FALSE(flight.tracks()[0].velocity_in_enu);
  EXPECT_TRUE(flight.tracks()[1].velocity_in_enu);
  EXPECT_FALSE(flight.tracks()[2].velocity_in_enu);
}

TEST(MovingObjects, AreNeverMoreThanMayBe) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.max_tracks = 2;
  NadirFlight flight = watching(config);
  flight.process(0.5, {at({-5.0, 0.0}), at({0.0, 0.0}), at({5.0, 0.0})});
  EXPECT_EQ(flight.tracks().size(), 2U);
  EXPECT_EQ(flight.geolocator().track_counters().refused, 1U);
}

/// The vehicle's constant error is the object's too; its wandering and the frame's noise count once.
TEST(MovingObjects, AreNoBetterKnownThanTheVehicle) {
  GeolocatorConfig config = noisy_by_the_detector_alone();
  config.joint.horizontal_accuracy_m = 2.0;
  config.joint.constant_share = 0.5;
  NadirFlight flight = watching(config);
  for (int frame = 0; frame < 30; ++frame) flight.process(0.5 + 0.1 * frame, {at({1.0, 0.0})});
  const double constant = 0.5 * 0.5 * 4.0, wandering = constant;  // per axis
  for (int axis = 0; axis < 2; ++axis) {
    const double variance = flight.tracks()[0].position_in_enu.covariance(axis, axis);
    EXPECT_NEAR(variance, constant + wandering, 0.02);
  }
}

}  // namespace
}  // namespace geoloc
