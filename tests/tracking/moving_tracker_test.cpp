// SPDX-License-Identifier: Apache-2.0
#include "tracking/moving_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracking/looking_down.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

constexpr int kCar = 2, kTruck = 3;
constexpr double kDetected = 0.9;

class MovingTracks : public ::testing::Test {
 protected:
  static JointTrackerConfig config() {
    JointTrackerConfig config;
    config.moving.classes = {kCar, kTruck};
    config.class_mismatch_cost = 1000.0;
    return config;
  }

  void see(double time_s, const std::vector<Eigen::Vector2d>& places, int class_id = kCar) {
    std::vector<Look> looks;
    for (const Eigen::Vector2d& place : places) {
      looks.push_back(testing::lone_look(place, 1e-3));
      looks.back().detection.class_id = class_id;
      looks.back().detection.confidence = 0.9;
    }
    const FrameShift shift{correction_, {0.0, 0.0}, {0.0, 0.0}, 0.0};
    tracker_.update(looks, {camera_.frame_at(time_s), shift, Eigen::Matrix2d::Zero(), kDetected}, book_);
  }

  testing::LookingDown camera_;
  JointTrackerConfig config_ = config();
  MovingTracker tracker_{config_, 10};
  TrackBook book_;
  Eigen::Vector2d correction_ = Eigen::Vector2d::Zero();
};

/// The vehicle is known to be five metres off: what is north of the image's edge by the map is in the image.
TEST_F(MovingTracks, AreMissedWhereTheFrameShouldShowThem) {
  correction_ = {0.0, 5.0};
  see(1.0, {{0.0, 8.0}, {0.0, -4.0}});
  const double at_birth = tracker_.objects()[1].existence.probability();
  see(1.1, {});
  ASSERT_EQ(tracker_.objects().size(), 2U);
  const double missed = tracker_.objects()[0].existence.probability();
  EXPECT_NEAR(std::log(missed / (1.0 - missed)),
              std::log(at_birth / (1.0 - at_birth)) + std::log(1.0 - kDetected), 1e-9);
  EXPECT_EQ(tracker_.objects()[1].existence.probability(), at_birth);
}

/// Looks of two classes by turns are two tracks, until both are known well enough: then they are one, which
/// was seen as lately and as often as both, and is as surely there as the surer of them.
TEST_F(MovingTracks, ThatBecomeOneKnowWhatBothKnew) {
  double surest = 0.0;
  for (int frame = 0; frame < 6; ++frame) {
    for (const MovingObject& object : tracker_.objects())
      surest = std::max(surest, object.existence.probability());
    see(1.0 + 0.1 * frame, {{1.0, 0.0}}, frame % 2 == 0 ? kCar : kTruck);
    ASSERT_EQ(tracker_.objects().size(), frame == 0 || frame == 5 ? 1U : 2U) << frame;
  }
  const MovingObject& kept = tracker_.objects()[0];
  EXPECT_EQ(kept.track.id, 1U);
  EXPECT_EQ(kept.track.hits, 6);
  EXPECT_EQ(kept.last_look, VehicleTime{from_seconds(1.5)});
  EXPECT_GE(kept.existence.probability(), surest);
  EXPECT_EQ(book_.counters.merged, 1U);
}

}  // namespace
}  // namespace geoloc
