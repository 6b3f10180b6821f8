// SPDX-License-Identifier: Apache-2.0
#include "tracking/misses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/noise.hpp"
#include "tracking/looking_down.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

constexpr double kFound = 0.9;

/// One frame's misses, of objects half a metre large.
class Misses : public ::testing::Test {
 protected:
  Misses() { errors_.drift.cover(VehicleTime{}, 0.5); }

  RestingObject& append(const Eigen::Vector2d& place, TrackStatus status, int hits) {
    RestingObject& object = testing::append_seen(tracks_, errors_, place, hits, 0.01);
    object.track.status = status;
    object.size_m = 0.5;
    return object;
  }

  /// True where two tracks are to be compared.
  bool weigh(const FrameShift& shift) {
    return weigh_missed(looks_, camera_.frame_at(1.0), shift, config_, detection_rate_, tracks_);
  }

  static double log_odds(const RestingObject& object) {
    return std::log(object.existence.probability() / (1.0 - object.existence.probability()));
  }

  testing::LookingDown camera_;
  JointTrackerConfig config_;
  DetectionRate detection_rate_{kFound};
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{4};
  std::vector<Look> looks_;
};

/// The frame shows a place at itself minus what the vehicle's position is known to be off by, and shifted as
/// all of its looks are.
TEST_F(Misses, CountWhereTheFrameShouldShowTheObject) {
  const FrameShift shift{{0.0, 4.0}, {0.0, 1.0}, {0.0, 2.0}, 0.0};
  RestingObject& north = append({0, 8}, TrackStatus::kTentative, 1);
  RestingObject& south = append({0, -5}, TrackStatus::kTentative, 1);
  EXPECT_FALSE(weigh(shift));
  EXPECT_NEAR(log_odds(north), std::log(1.0 - kFound), 1e-9);
  EXPECT_EQ(log_odds(south), 0.0);
}

/// A younger track beside a confirmed one, which may be the same object, has its look: until they are known
/// well enough to be compared, at three looks.
TEST_F(Misses, DoNotCountWhileAYoungTrackMayBeTheSameObject) {
  for (const int hits : {1, 2, 3, 4}) {
    TrackTable tracks(2);
    for (const double east : {0.0, 1.0}) {
      RestingObject& object = testing::append_seen(tracks, errors_, {east, 0.0}, 1, 0.01);
      object.size_m = 0.5;
    }
    tracks[0].track.status = TrackStatus::kConfirmed;
    tracks[0].track.hits = 50;
    tracks[1].is_seen = true;
    tracks[1].track.hits = hits;
    const FrameShift none{{0, 0}, {0, 0}, {0, 0}, 0.0};
    const JointFrame frame = camera_.frame_at(1.0);
    EXPECT_EQ(weigh_missed(looks_, frame, none, config_, detection_rate_, tracks), hits == 3) << hits;
    EXPECT_EQ(log_odds(tracks[0]) < 0.0, hits > 3) << hits;
    tracks[1].is_compared = true;
    EXPECT_FALSE(weigh_missed(looks_, frame, none, config_, detection_rate_, tracks));
  }
}

}  // namespace
}  // namespace geoloc
