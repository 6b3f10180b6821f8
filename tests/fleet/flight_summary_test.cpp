// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/flight_summary.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <random>

#include "fleet/synthetic_fleet.hpp"

namespace geoloc {
namespace {

using testing::clustered_targets;
using testing::draw_flight;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FlightSummary any_flight(std::size_t objects = 12) {
  std::mt19937 random(3);
  return draw_flight("a", clustered_targets(objects, random), {}, random);
}

/// Of all objects' positions.
Eigen::MatrixXd joint_covariance(const FlightSummary& summary) {
  Eigen::MatrixXd covariance = summary.shared_error * summary.shared_error.transpose();
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    const auto at = 3 * static_cast<Eigen::Index>(i);
    covariance.block<3, 3>(at, at) += summary.objects[i].own_covariance;
  }
  return covariance;
}

/// A random joint estimate: shared errors by far more unknowns than matter.
JointEstimate any_estimate(std::mt19937& random) {
  std::normal_distribution<double> normal;
  constexpr Eigen::Index kObjects = 20, kErrors = 45;
  JointEstimate estimate;
  estimate.shared_error.resize(3 * kObjects, kErrors);
  for (Eigen::Index column = 0; column < kErrors; ++column) {
    for (Eigen::Index row = 0; row < 3 * kObjects; ++row)
      estimate.shared_error(row, column) = normal(random) * std::pow(0.7, static_cast<double>(column));
  }
  for (Eigen::Index i = 0; i < kObjects; ++i) {
    JointEstimate::Object object;
    object.track.id = static_cast<std::uint64_t>(i) + 1;
    object.track.hits = 5;
    object.track.existence = 0.9;
    Eigen::Matrix3d root;
    for (Eigen::Index k = 0; k < 9; ++k) root(k) = normal(random);
    const Eigen::Matrix3d square = root * root.transpose();
    object.own_covariance = 0.01 * Eigen::Matrix3d::Identity() + 0.025 * (square + square.transpose());
    object.position_in_enu = {normal(random), normal(random), normal(random)};
    estimate.objects.push_back(object);
  }
  estimate.flight_state.shared_error.resize(5, kErrors);
  for (double& element : estimate.flight_state.shared_error.reshaped()) element = normal(random);
  for (int i = 0; i < 5; ++i)
    estimate.flight_state.unknowns.push_back({static_cast<FlightUnknown>(2 * i), 0.1 * i, 0.0, 10.0});
  return estimate;
}

TEST(FlightSummary, HasNoProblemsAsItIsDrawn) {
  EXPECT_TRUE(any_flight().problems().empty());
}

TEST(FlightSummary, NamesEveryFault) {
  const FlightSummary good = any_flight();
  const auto is_refused = [&](auto spoil) {
    FlightSummary spoilt = good;
    spoil(spoilt);
    return !spoilt.problems().empty();
  };
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.identity.flight = ""; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.identity.flight = "a b"; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.identity.vehicle = std::string(65, 'a'); }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.origin.latitude_deg = kNan; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.home_height_msl_m = kNan; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].position_in_enu.y() = kNan; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].position_in_enu.y() = 2e5; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].own_covariance(0, 1) = 0.5; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].own_covariance.setZero(); }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].own_covariance *= -1.0; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].own_covariance(2, 2) = kNan; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].own_covariance(2, 2) = 1e11; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].existence = 1.5; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].hits = 0; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.objects[3].id = s.objects[2].id; }));
  EXPECT_TRUE(
      is_refused([](FlightSummary& s) { s.objects[3].first_seen = s.objects[3].last_seen + Duration{1}; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) {
    ClassVotes::Votes votes{};
    votes[0] = {1, kNan};
    s.objects[3].class_votes = ClassVotes(votes);
  }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.shared_error(5, 1) = kNan; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.shared_error(5, 1) = 1e6; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.shared_error.conservativeResize(6, 4); }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.apart = {{3, 2}}; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.apart = {{3, 12}}; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.apart = {{3, 4}, {1, 2}}; }));
  EXPECT_TRUE(is_refused([](FlightSummary& s) { s.apart = {{1, 2}, {1, 2}}; }));
  EXPECT_FALSE(is_refused([](FlightSummary& s) { s.apart = {{1, 2}, {3, 4}}; }));
}

TEST(FlightSummary, FaultsAreNamedWithTheirObject) {
  FlightSummary spoilt = any_flight();
  spoilt.objects[4].hits = 0;
  spoilt.objects[6].existence = 2.0;
  const auto problems = spoilt.problems();
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0], "object 5: hits must be above 0");
  EXPECT_EQ(problems[1], "object 7: existence must be between 0 and 1");
}

/// What the estimator knows is in the summary: the joint covariance of all positions, but for a thousandth of
/// any combination's variance.
TEST(Summarize, KeepsTheJointCovariance) {
  std::mt19937 random(11);
  const JointEstimate estimate = any_estimate(random);
  const FlightSummary summary = summarize(estimate, {"a", "", 1}, testing::kFleetOrigin, std::nullopt);
  ASSERT_TRUE(summary.problems().empty());
  FlightSummary whole = summary;
  whole.shared_error = estimate.shared_error;
  for (std::size_t i = 0; i < whole.objects.size(); ++i)
    whole.objects[i].own_covariance = estimate.objects[i].own_covariance;
  const Eigen::MatrixXd expected = joint_covariance(whole), actual = joint_covariance(summary);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ratio(actual, expected);
  EXPECT_GT(ratio.eigenvalues().minCoeff(), 0.999);
  EXPECT_LT(ratio.eigenvalues().maxCoeff(), 1.001);
  for (std::size_t i = 0; i < whole.objects.size(); ++i)
    EXPECT_LT((whole.covariance(i) - summary.covariance(i)).norm(), 1e-12);
  EXPECT_LT(summary.shared_count(), estimate.shared_error.cols());
}

/// The covariance of what outlasts the run is kept whole, and with objects as the objects' own.
TEST(Summarize, KeepsWhatOutlastsTheRun) {
  std::mt19937 random(14);
  const JointEstimate estimate = any_estimate(random);
  const FlightSummary summary =
      summarize(estimate, {"a", "", 1}, testing::kFleetOrigin, std::nullopt, FlightRun{"tuesday", {}, {}});
  ASSERT_TRUE(summary.problems().empty()) << summary.problems().front();
  const Eigen::MatrixXd &rows = summary.part->state.shared_error, &whole = estimate.flight_state.shared_error;
  EXPECT_LT((rows * rows.transpose() - whole * whole.transpose()).norm(), 1e-12);
  EXPECT_LT(rows.cols(), whole.cols());
  const Eigen::MatrixXd with_objects =
      summary.shared_error * rows.leftCols(summary.shared_count()).transpose();
  const Eigen::MatrixXd expected = estimate.shared_error * whole.transpose();
  EXPECT_LT((with_objects - expected).norm(), 0.01 * expected.norm());
}

/// Nothing that no object shows, and what outlasts the run nevertheless.
TEST(Summarize, AFlightWithoutObjectsKeepsWhatOutlastsIt) {
  std::mt19937 random(15);
  JointEstimate estimate = any_estimate(random);
  estimate.objects.clear();
  estimate.shared_error.resize(0, estimate.shared_error.cols());
  const FlightSummary summary =
      summarize(estimate, {"a", "", 1}, testing::kFleetOrigin, std::nullopt, FlightRun{});
  ASSERT_TRUE(summary.problems().empty()) << summary.problems().front();
  const Eigen::MatrixXd &rows = summary.part->state.shared_error, &whole = estimate.flight_state.shared_error;
  EXPECT_EQ(rows.cols(), 5);
  EXPECT_LT((rows * rows.transpose() - whole * whole.transpose()).norm(), 1e-12);
}

TEST(Summarize, PutsWhatMovesAllObjectsIntoTheFirstThreeErrors) {
  std::mt19937 random(12);
  const FlightSummary summary =
      summarize(any_estimate(random), {"a", "", 1}, testing::kFleetOrigin, std::nullopt);
  const auto shift = common_shift(summary);
  EXPECT_GT(shift.leftCols<3>().norm(), 0.1);
  EXPECT_LT(shift.rightCols(shift.cols() - 3).norm(), 1e-4);  // what was dropped changed the weights a little
}

TEST(TransformedTo, PlacesOnTheGlobeStay) {
  const FlightSummary summary = any_flight();
  const LocalFrame old_frame(summary.origin), new_frame({-22.7, -42.9});
  const FlightSummary moved = transformed_to(new_frame, summary);
  EXPECT_TRUE(moved.problems().empty());
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    const Geodetic before = old_frame.to_geodetic(summary.objects[i].position_in_enu.head<2>());
    const Geodetic after = new_frame.to_geodetic(moved.objects[i].position_in_enu.head<2>());
    EXPECT_NEAR(before.latitude_deg, after.latitude_deg, 1e-12);
    EXPECT_NEAR(before.longitude_deg, after.longitude_deg, 1e-12);
  }
}

/// Differences of places and the errors turn by the same angle.
TEST(TransformedTo, ErrorsTurnWithThePlaces) {
  FlightSummary summary = any_flight(2);
  summary.objects[0].position_in_enu.setZero();
  summary.objects[1].position_in_enu = {0.0, 100.0, 0.0};
  summary.shared_error.resize(6, 1);
  summary.shared_error << 0.0, 1.0, 0.0, 0.0, 1.0, 0.0;  // north
  summary.objects[0].own_covariance.diagonal() << 0.01, 4.0, 1.0;
  const LocalFrame frame({-23.2, -42.8});
  const FlightSummary moved = transformed_to(frame, summary);
  const Eigen::Vector2d north =
      (moved.objects[1].position_in_enu - moved.objects[0].position_in_enu).head<2>().normalized();
  EXPECT_GT(std::abs(north.x()), 1e-3);  // the meridians do converge
  EXPECT_LT((moved.shared_error.block<2, 1>(0, 0) - north).norm(), 2e-5);
  const Eigen::Vector2d east(north.y(), -north.x());
  const Eigen::Matrix2d own = moved.objects[0].own_covariance.topLeftCorner<2, 2>();
  EXPECT_NEAR(north.dot(own * north), 4.0, 1e-6);
  EXPECT_NEAR(east.dot(own * east), 0.01, 1e-6);
}

/// What is off by a metre to the north is so by the other frame's north, which is turned.
TEST(TransformedTo, OffsetsOfTheReceiverTurn) {
  FlightSummary summary = any_flight(2);
  FlightSummary::Part part;
  part.state.unknowns = {{FlightUnknown::kHeight, 2.0, 0.0, 1.0},
                         {FlightUnknown::kOffsetEast, 0.0, 0.0, 1.0},
                         {FlightUnknown::kOffsetNorth, 1.0, 0.0, 1.0}};
  part.state.shared_error = Eigen::Matrix3d::Identity();
  summary.part = part;
  const LocalFrame frame({-23.2, -42.8});
  const FlightState moved = transformed_to(frame, summary).part->state;
  const double turn_rad = frame.to_local(summary.origin).convergence_rad;
  EXPECT_GT(std::abs(turn_rad), 1e-3);
  EXPECT_EQ(moved.unknowns[0].mean, 2.0);
  EXPECT_NEAR(moved.unknowns[1].mean, std::sin(turn_rad), 1e-12);
  EXPECT_NEAR(moved.unknowns[2].mean, std::cos(turn_rad), 1e-12);
  EXPECT_NEAR(moved.shared_error(2, 2), std::cos(turn_rad), 1e-12);
  EXPECT_NEAR(moved.shared_error(1, 2), std::sin(turn_rad), 1e-12);
}

TEST(TransformedTo, ThereAndBackIsTheSame) {
  const FlightSummary summary = any_flight();
  const LocalFrame here(summary.origin), there({-22.6, -43.4});
  const FlightSummary back = transformed_to(here, transformed_to(there, summary));
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    EXPECT_LT((back.objects[i].position_in_enu - summary.objects[i].position_in_enu).norm(), 1e-6);
    EXPECT_LT((back.objects[i].own_covariance - summary.objects[i].own_covariance).norm(), 1e-7);
  }
  EXPECT_LT((back.shared_error - summary.shared_error).norm(), 1e-5);
}

}  // namespace
}  // namespace geoloc
