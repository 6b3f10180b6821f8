// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/joint_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Pose;

std::vector<Eigen::Vector3d> places() {
  std::vector<Eigen::Vector3d> all;
  for (double north = 0.0; north <= 80.0; north += 6.0) {
    for (const double east : {-6.0, 0.0, 5.0}) all.emplace_back(east, north, 0.1 * east);
  }
  return all;
}

/// To the north at 3 m/s: objects leave the view and sleep.
Pose northwards(double time_s) {
  return {{0.0, 3.0 * time_s, 20.0}, 0.02 * std::sin(0.7 * time_s), 0.02 * std::cos(0.5 * time_s), 0.0};
}

/// Flown up to that time; `ask`: how often on the way the joint estimate is asked for.
NadirFlight flown(double end_s, int ask_every = 0) {
  NadirFlight flight(GeolocatorConfig{}, northwards);
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int i = 0; 0.1 * i < end_s; ++i) {
    flight.see_points(0.1 * i, places(), [&] { return noise(random); });
    if (ask_every > 0 && i % ask_every == 0) static_cast<void>(flight.geolocator().joint_estimate());
  }
  return flight;
}

TEST(JointEstimate, IsOfAllConfirmedObjectsAwakeOrAsleep) {
  constexpr double kEnd_s = 25.0;
  const NadirFlight flight = flown(kEnd_s);
  const auto estimate = flight.geolocator().joint_estimate();
  ASSERT_TRUE(estimate);
  std::size_t confirmed = 0;
  for (const Track& track : flight.tracks()) confirmed += track.status == TrackStatus::kConfirmed;
  EXPECT_GT(confirmed, 30U);
  ASSERT_EQ(estimate->objects.size(), confirmed);
  auto object = estimate->objects.begin();
  for (const Track& track : flight.tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    ASSERT_EQ(object->track.id, track.id);
    // Published ones are up to date but for the looks since the last solution.
    EXPECT_LT((object->position_in_enu.head<2>() - track.position_in_enu.mean).norm(), 0.03);
    EXPECT_NEAR(object->position_in_enu.z(), track.height->above_home_m, 0.06);
    const auto i = static_cast<Eigen::Index>(object - estimate->objects.begin());
    const auto shared = estimate->shared_error.middleRows<3>(3 * i);
    const Eigen::Matrix3d covariance = object->own_covariance + shared * shared.transpose();
    ++object;
    if (track.last_seen > testing::host_at_s(kEnd_s - 5.0)) continue;  // its looks since tell more of it
    EXPECT_NEAR(std::sqrt(covariance(0, 0) / track.position_in_enu.covariance(0, 0)), 1.0, 0.1);
    EXPECT_NEAR(std::sqrt(covariance(1, 1) / track.position_in_enu.covariance(1, 1)), 1.0, 0.12);
  }
}

TEST(JointEstimate, AskingForItChangesNothing) {
  const NadirFlight asked = flown(20.0, 7), left_alone = flown(20.0);
  ASSERT_EQ(asked.tracks().size(), left_alone.tracks().size());
  for (std::size_t i = 0; i < asked.tracks().size(); ++i) {
    EXPECT_EQ(asked.tracks()[i].position_in_enu.mean, left_alone.tracks()[i].position_in_enu.mean);
    EXPECT_EQ(asked.tracks()[i].position_in_enu.covariance,
              left_alone.tracks()[i].position_in_enu.covariance);
    EXPECT_EQ(asked.tracks()[i].height->above_home_m, left_alone.tracks()[i].height->above_home_m);
  }
}

TEST(JointEstimate, NeighboursInOneFrameAreApart) {
  NadirFlight flight(GeolocatorConfig{}, northwards);
  const std::vector<Eigen::Vector3d> pair{{0.0, 10.0, 0.0}, {1.4, 10.0, 0.0}, {-5.0, 20.0, 0.0}};
  for (int i = 0; i < 80; ++i) flight.see_points(0.1 * i, pair, [] { return 0.0; });
  const auto estimate = flight.geolocator().joint_estimate();
  ASSERT_TRUE(estimate);
  ASSERT_EQ(estimate->objects.size(), 3U);
  ASSERT_EQ(estimate->apart.size(), 1U);
  const auto [first, second] = estimate->apart.front();
  EXPECT_NEAR((estimate->objects[first].position_in_enu - estimate->objects[second].position_in_enu).norm(),
              1.4, 0.1);
}

TEST(JointEstimate, ThePaperMethodHasNone) {
  GeolocatorConfig config;
  config.method = Method::kPaper;
  NadirFlight flight(config, northwards);
  for (int i = 0; i < 20; ++i) flight.see_points(0.1 * i, places(), [] { return 0.0; });
  EXPECT_FALSE(flight.geolocator().joint_estimate());
}

TEST(JointEstimate, IsNoneBeforeAFlightBegins) {
  EXPECT_FALSE(Geolocator{GeolocatorConfig{}}.joint_estimate());
}

/// What another run over the flight has in common with this one, as the estimator tells it elsewhere.
TEST(JointEstimate, TellsOfWhatOutlastsTheRun) {
  NadirFlight flight(GeolocatorConfig{}, northwards);
  flight.set_accuracy(1.5);
  for (int i = 0; i < 150; ++i) flight.see_points(0.1 * i, places(), [] { return 0.0; });
  const auto estimate = flight.geolocator().joint_estimate();
  ASSERT_TRUE(estimate);
  const FlightState& state = estimate->flight_state;
  ASSERT_EQ(state.unknowns.size(), 16U);  // the focal length is known
  EXPECT_EQ(state.shared_error.cols(), estimate->shared_error.cols());
  const auto calibration = flight.geolocator().calibration();
  for (std::size_t i = 0; i < state.unknowns.size(); ++i) {
    const FlightState::Unknown& unknown = state.unknowns[i];
    const double sigma = state.shared_error.row(static_cast<Eigen::Index>(i)).norm();
    EXPECT_LE(sigma, unknown.prior_sigma * (1.0 + 1e-9)) << i;
    if (unknown.which != FlightUnknown::kHeight && unknown.which != FlightUnknown::kOffsetEast) continue;
    const int index = static_cast<int>(unknown.which);
    EXPECT_NEAR(unknown.mean, calibration->mean[index], 0.05) << i;
    EXPECT_NEAR(sigma, calibration->sigma(index), 0.1 * sigma) << i;
  }
  EXPECT_EQ(state.first_node_at, testing::at_s(0.0));
  EXPECT_GT(state.last_node_at, testing::at_s(14.0));
  EXPECT_LT(state.last_node_at, testing::at_s(19.0));
}

/// The receiver's constant error is in it: no look shows it, and other flights may.
TEST(JointEstimate, SummarisedHoldsTheReceiversOffset) {
  NadirFlight flight(GeolocatorConfig{}, northwards);
  flight.set_accuracy(1.5);
  for (int i = 0; i < 150; ++i) flight.see_points(0.1 * i, places(), [] { return 0.0; });
  const auto estimate = flight.geolocator().joint_estimate();
  ASSERT_TRUE(estimate);
  const FlightSummary summary = summarize(*estimate, {"a", "", 1}, {-22.906, -43.133}, 10.0);
  EXPECT_TRUE(summary.problems().empty()) << summary.problems().front();
  const auto shift = common_shift(summary);
  const double stated_m = flight.geolocator().calibration()->sigma(CalibrationIndex::kOffset);
  const double shared_m = shift.row(0).norm();
  EXPECT_GT(stated_m, 0.01);
  EXPECT_GE(shared_m, 0.95 * stated_m);
}

}  // namespace
}  // namespace geoloc
