// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "sim/flights_for_test.hpp"
#include "truth_file.hpp"

namespace geoloc::sim {
namespace {

VehicleTime at(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

EulerAngles attitude_of(const Rigid3d& enu_from_body) {
  return euler_angles(enu_from_ned().conjugate() * enu_from_body.rotation);
}

std::vector<TrueState> turn_through_south() {
  TrueState before{at(1.0), {-22.9060, -43.1330}, 10.0, {0.0, 0.0, 170 * kRadPerDeg}};
  TrueState after{at(2.0), {-22.9059, -43.1330}, 30.0, {0.0, 0.0, -170 * kRadPerDeg}};
  return {before, after};
}

TEST(Trajectory, PassesThroughEveryRowOfTheTruthFile) {
  const auto rows = read_truth_file(flight_folder() / "stock_path5_truth.csv.gz");
  const Trajectory trajectory(rows, Site{});
  ASSERT_GT(rows.size(), 20000U);
  for (std::size_t i = 0; i < rows.size(); i += 7) {
    const auto pose = trajectory.pose(rows[i].time);
    ASSERT_TRUE(pose);
    const Geodetic position = trajectory.frame().to_geodetic(pose->translation.head<2>());
    EXPECT_NEAR(position.latitude_deg, rows[i].position.latitude_deg, 1e-10);
    EXPECT_NEAR(position.longitude_deg, rows[i].position.longitude_deg, 1e-10);
    EXPECT_NEAR(pose->translation.z(), rows[i].height_msl_m - 10.0, 1e-9);
    const EulerAngles attitude = attitude_of(*pose);
    constexpr double kConvergence_rad = 5e-6;  // of the meridians, at most, over the flight's area
    EXPECT_NEAR(attitude.roll_rad, rows[i].attitude.roll_rad, kConvergence_rad);
    EXPECT_NEAR(attitude.pitch_rad, rows[i].attitude.pitch_rad, kConvergence_rad);
    EXPECT_NEAR(wrap_to_pi(attitude.yaw_rad - rows[i].attitude.yaw_rad), 0.0, kConvergence_rad);
  }
}

TEST(Trajectory, GoesStraightAndTurnsTheShortWayBetweenSamples) {
  const Trajectory trajectory(turn_through_south(), Site{});
  const auto middle = trajectory.pose(at(1.5));
  ASSERT_TRUE(middle);
  EXPECT_NEAR(std::abs(attitude_of(*middle).yaw_rad), kPi, 1e-6);
  EXPECT_NEAR(middle->translation.z(), 10.0, 1e-9);
  // 0.0001 deg of the meridian at this latitude: its radius of curvature on WGS84 is 6345109 m.
  EXPECT_NEAR(middle->translation.y(), 0.5 * 0.0001 * kRadPerDeg * 6345109.0, 1e-4);
}

TEST(Trajectory, KnowsNothingBeyondItsEnds) {
  const Trajectory trajectory(turn_through_south(), Site{});
  EXPECT_TRUE(trajectory.pose(at(1.0)));
  EXPECT_TRUE(trajectory.pose(at(2.0)));
  EXPECT_FALSE(trajectory.pose(at(1.0) - Duration{1}));
  EXPECT_FALSE(trajectory.pose(at(2.0) + Duration{1}));
}

TEST(Trajectory, RefusesWhatIsNoTrajectory) {
  auto states = turn_through_south();
  EXPECT_THROW(Trajectory({states[0]}, Site{}), std::invalid_argument);
  EXPECT_THROW(Trajectory({states[0], states[0]}, Site{}), std::invalid_argument);
  EXPECT_THROW(Trajectory({states[1], states[0]}, Site{}), std::invalid_argument);
  states[1].height_msl_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Trajectory(states, Site{}), std::invalid_argument);
}

TEST(Trajectory, SurveyIsTheTimeAtHeight) {
  const Trajectory trajectory(read_truth_file(flight_folder() / "stock_path1_truth.csv.gz"), Site{});
  const TimeSpan survey = trajectory.survey();
  EXPECT_NEAR(seconds(survey.begin - at(64.5)), 0.0, 0.2);  // read off the CSV: above 19 m from here
  EXPECT_NEAR(seconds(survey.end - at(224.4)), 0.0, 0.2);   // to here
}

}  // namespace
}  // namespace geoloc::sim
