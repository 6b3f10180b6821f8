// SPDX-License-Identifier: Apache-2.0
#include "tracking/clock_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tracking/watched_flight.hpp"

namespace geoloc {
namespace {

using testing::WatchedFlight;

const std::vector<Eigen::Vector2d> kObjects{{-6, 2},  {4, 5},  {-3, 9},  {7, 14}, {0, 18},
                                            {-7, 22}, {5, 27}, {-2, 31}, {6, 36}, {1, 40}};

class WatchedClock : public ::testing::Test {
 protected:
  /// A frame of that time, stamped later.
  std::optional<LatencyPrior> see(double exposed_s, double late_s,
                                  const std::vector<Eigen::Vector2d>& objects) {
    flight_.fly_until(std::max(exposed_s, exposed_s + late_s));
    if (!watch_.is_in_doubt()) list_known(kObjects);
    const CalibratedViewer viewer = flight_.viewer();
    return watch_.observe(WatchedFlight::stamp(exposed_s + late_s), flight_.boxes(exposed_s, objects),
                          PlaceFit(viewer, expected_));
  }

  void list_known(const std::vector<Eigen::Vector2d>& objects) {
    watch_.places().clear();
    for (const Eigen::Vector2d& place : objects)
      watch_.places().push_back({{place.x(), place.y(), 0.0}, 0.05, 0.0, 0.0, true});
  }

  WatchedFlight flight_{testing::in_gusts};
  ClockWatch watch_{100};
  WatchExpectation expected_{0.95, 0.05, 1.5, 0.002, 0.1};
};

TEST_F(WatchedClock, IsProvenByFramesThatShowObjectsInPlaceAndHoldsNone) {
  int proofs = 0;
  for (double time_s = 4.0; time_s < 14.0; time_s += 0.1) {
    EXPECT_FALSE(see(time_s, 0.0, kObjects));
    EXPECT_FALSE(watch_.holds());
    proofs += watch_.proves() ? 1 : 0;
  }
  EXPECT_GT(proofs, 50);
}

/// In one frame a neighbour may stand where the known object should be.
TEST_F(WatchedClock, IsNotProvenByLessThanHalfASecondOfFrames) {
  for (double time_s = 4.0; time_s < 4.45; time_s += 0.1) {
    see(time_s, 0.0, kObjects);
    EXPECT_FALSE(watch_.proves());
  }
  for (double time_s = 4.5; time_s < 9.0; time_s += 0.1) see(time_s, 0.0, {});
  see(9.0, 0.0, kObjects);
  EXPECT_FALSE(watch_.proves()) << "after a pause";
}

TEST_F(WatchedClock, IsNotProvenWhileAnotherLatencyWouldShowTheSame) {
  WatchedFlight hovering(testing::hovering_at({0.0, 0.0, 20.0}));
  list_known(kObjects);
  for (double time_s = 4.0; time_s < 6.0; time_s += 0.1) {
    hovering.fly_until(time_s);
    const CalibratedViewer viewer = hovering.viewer();
    watch_.observe(WatchedFlight::stamp(time_s), hovering.boxes(time_s, kObjects),
                   PlaceFit(viewer, expected_));
    EXPECT_FALSE(watch_.proves());
    EXPECT_FALSE(watch_.holds());
  }
}

TEST_F(WatchedClock, ThatStepsIsHeldFromTheFirstFrameOnUntilItIsKnown) {
  for (const double step_s : {-2.9, -1.0, -0.3, 0.3, 1.0, 2.9}) {
    SCOPED_TRACE(step_s);
    watch_.begin_anew();
    flight_.errors.calibration.mean[CalibrationIndex::kLatency] = 0.0;
    std::optional<LatencyPrior> found;
    for (double time_s = 40.0; time_s < 52.0 && !found; time_s += 0.1) {
      found = see(time_s, step_s, kObjects);
      EXPECT_TRUE(found || watch_.holds());
    }
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->latency_s, step_s, 0.03);
    EXPECT_FALSE(watch_.holds());
  }
}

TEST_F(WatchedClock, IsOutOfDoubtSoonAfterAShakenFrame) {
  for (double time_s = 4.0; time_s < 6.0; time_s += 0.1) see(time_s, 0.0, kObjects);
  auto shaken = flight_.boxes(6.0, kObjects);
  for (LocatedDetection& located : shaken) located.detection.box.x += 80.0;
  const CalibratedViewer viewer = flight_.viewer();
  watch_.observe(WatchedFlight::stamp(6.0), shaken, PlaceFit(viewer, expected_));
  EXPECT_TRUE(watch_.holds());
  see(6.1, 0.0, kObjects);
  see(6.2, 0.0, kObjects);
  EXPECT_FALSE(watch_.holds());
}

TEST_F(WatchedClock, IsNotDoubtedByFramesThatShowNothing) {
  for (double time_s = 4.0; time_s < 8.0; time_s += 0.1) {
    EXPECT_FALSE(see(time_s, 0.0, {}));
    EXPECT_FALSE(watch_.holds());
    EXPECT_FALSE(watch_.proves());
  }
}

TEST_F(WatchedClock, IsNotTakenToStepWhereAllElseHasChanged) {
  const std::vector<Eigen::Vector2d> others{{3, 3}, {-5, 12}, {2, 23}, {-4, 27}, {8, 30}, {-1, 37}};
  bool was_held = false;
  for (double time_s = 4.0; time_s < 30.0; time_s += 0.1) {
    EXPECT_FALSE(see(time_s, 0.0, others));
    was_held = was_held || watch_.holds();
  }
  EXPECT_TRUE(was_held);
  EXPECT_FALSE(watch_.holds()) << "given up";
}

}  // namespace
}  // namespace geoloc
