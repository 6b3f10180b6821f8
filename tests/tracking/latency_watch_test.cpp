// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tracking/watched_flight.hpp"

namespace geoloc {
namespace {

using testing::WatchedFlight;

const std::vector<Eigen::Vector2d> kGround{{-6, 2},  {4, 5},  {-3, 9},  {7, 14}, {0, 18},
                                           {-7, 22}, {5, 27}, {-2, 31}, {6, 36}, {1, 40}};

/// What is found in the first seconds, at ten frames a second, of a flight whose frames are stamped late.
std::optional<double> found_at_start(const testing::Path& path, double latency_s, double believed_s) {
  WatchedFlight flight(path);
  flight.errors.calibration.mean[CalibrationIndex::kLatency] = believed_s;
  LatencyWatch watch;
  for (double exposed_s = 4.0; exposed_s < 16.0; exposed_s += 0.1) {
    const double stamp_s = exposed_s + latency_s;
    flight.fly_until(exposed_s + std::max(latency_s, 0.0));
    const auto found =
        watch.observe(WatchedFlight::stamp(stamp_s), flight.boxes(exposed_s, kGround), flight.viewer(true));
    if (found) return found;
  }
  return std::nullopt;
}

TEST(LatencyWatch, FindsALatencyByHowTheVehicleTurned) {
  for (const double latency_s : {-2.9, -1.0, 1.0, 2.9}) {
    const auto found = found_at_start(testing::in_gusts, latency_s, 0.0);
    ASSERT_TRUE(found) << latency_s;
    EXPECT_NEAR(*found, latency_s, 0.05);
  }
}

TEST(LatencyWatch, LeavesALatencyAloneThatIsRight) {
  EXPECT_FALSE(found_at_start(testing::in_gusts, 0.0, 0.0));
  EXPECT_FALSE(found_at_start(testing::in_gusts, 0.4, 0.4));
}

TEST(LatencyWatch, LeavesToTheSolverWhatIsNear) {
  EXPECT_FALSE(found_at_start(testing::in_gusts, 0.1, 0.0));
}

TEST(LatencyWatch, GuessesNothingWhereTheVehicleFliesStraight) {
  EXPECT_FALSE(found_at_start(testing::straight_on, 1.0, 0.0));
}

/// From some time on the camera shakes, and no attitude tells it. Latencies for which the vehicle's states
/// are yet to come could be tried on the frames before only, which any latency explains.
TEST(LatencyWatch, TriesLatenciesOnTheFramesThatThePresentOneIsTriedOn) {
  constexpr double kShaking_s = 3.4;
  const auto shaken = [](double time_s) {
    testing::Pose pose = testing::straight_on(time_s);
    if (time_s < kShaking_s) return pose;
    pose.yaw = 0.5 * std::sin(7.3 * time_s);
    pose.pitch = 0.1 * std::sin(9.1 * time_s);
    return pose;
  };
  WatchedFlight told(testing::straight_on);
  const WatchedFlight shown(shaken);
  LatencyWatch watch;
  for (double exposed_s = 0.5; exposed_s < 8.0; exposed_s += 0.1) {
    told.fly_until(exposed_s);
    const auto found =
        watch.observe(WatchedFlight::stamp(exposed_s), shown.boxes(exposed_s, kGround), told.viewer(true));
    EXPECT_FALSE(found) << *found << " s at " << exposed_s << " s";
  }
}

TEST(LatencyWatch, EndsItsSearchAfterTheStart) {
  WatchedFlight flight(testing::in_gusts);
  LatencyWatch watch;
  EXPECT_TRUE(watch.is_at_start());
  for (int i = 0; i < 300; ++i) {
    flight.fly_until(0.1 * i);
    watch.observe(WatchedFlight::stamp(0.1 * i), flight.boxes(0.1 * i, kGround), flight.viewer(true));
  }
  EXPECT_FALSE(watch.is_at_start());
  watch.begin_anew();
  EXPECT_TRUE(watch.is_at_start());
}

}  // namespace
}  // namespace geoloc
