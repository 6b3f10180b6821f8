// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_change.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tracking/watched_flight.hpp"

namespace geoloc {
namespace {

using testing::WatchedFlight;

const std::vector<Eigen::Vector2d> kBelow{{-6, 2},  {4, 5},  {-3, 9},  {7, 14}, {0, 18},
                                          {-7, 22}, {5, 27}, {-2, 31}, {6, 36}, {1, 40}};

/// Frames ten times a second, from 4 s to 12 s, that are stamped later by `step_s` from 8 s on; none is taken
/// until a clock that was set back has caught up.
struct SteppedFrames {
  static constexpr std::size_t kFirstLate = 40;

  SteppedFrames(const testing::Path& path, double step_s) : flight(path), change{0.0, step_s} {
    flight.fly_until(20.0);
    double last_s = 0.0;
    for (int i = 0; i < 80; ++i) {
      const double exposed_s = 4.0 + 0.1 * i;
      const double stamp_s = exposed_s + (i < 40 ? 0.0 : step_s);
      if (stamp_s > last_s) add(exposed_s, stamp_s);
      last_s = std::max(last_s, stamp_s);
    }
  }

  void add(double exposed_s, double stamp_s) {
    const std::vector<LocatedDetection> boxes = flight.boxes(exposed_s, kBelow);
    const LocalFrame local_frame(Geodetic{});
    const GroundModel ground(3.0);
    const FrameView view;
    frames.add({boxes, flight.projector, view, local_frame, WatchedFlight::stamp(stamp_s),
                flight.frame_viewer, ground, std::nullopt},
               false);
    frames.count_newest_as_used();
  }

  /// Nothing is known of the ground.
  ChangeOfLatency found() {
    const CalibratedViewer viewer = flight.viewer();
    const WatchExpectation expected{0.95, 0.05, 1.5, 0.002, 0.1};
    return find_change(frames, change, PlaceFit(viewer, expected), {});
  }

  WatchedFlight flight;
  WaitingFrames frames{32};
  LatencyChange change;
};

TEST(ChangeOfLatency, LiesWhereTheTurningIsExplainedOnEitherSide) {
  for (const double step_s : {-2.9, -1.0, -0.3, 0.3, 1.0, 2.9}) {
    SCOPED_TRACE(step_s);
    const ChangeOfLatency found = SteppedFrames(testing::in_gusts, step_s).found();
    EXPECT_LE(found.first_possible, SteppedFrames::kFirstLate);
    EXPECT_GE(found.first_certain, SteppedFrames::kFirstLate);
    EXPECT_LT(found.first_certain - found.first_possible, 20U);
    EXPECT_GT(found.lead, 0.0);
  }
}

TEST(ChangeOfLatency, AheadLiesAtTheGapThatItLeavesInTheStamps) {
  const ChangeOfLatency found = SteppedFrames(testing::straight_on, 1.0).found();
  EXPECT_EQ(found.first_certain, SteppedFrames::kFirstLate);
}

TEST(ChangeOfLatency, MayLieAnywhereWhereNothingTellsIt) {
  SteppedFrames stepped(testing::hovering_at({0.0, 0.0, 20.0}), -1.0);
  const ChangeOfLatency found = stepped.found();
  EXPECT_EQ(found.first_possible, 0U);
  EXPECT_EQ(found.first_certain, stepped.frames.size());
}

TEST(ChangeOfLatency, LeavesToBeUsedAnewWhatIsCertainlyLate) {
  SteppedFrames stepped(testing::in_gusts, 1.0);
  stepped.frames.use_again_from(SteppedFrames::kFirstLate);
  EXPECT_EQ(stepped.frames.size(), 80 - SteppedFrames::kFirstLate);
  EXPECT_EQ(stepped.frames.due(), stepped.frames.size());
}

}  // namespace
}  // namespace geoloc
