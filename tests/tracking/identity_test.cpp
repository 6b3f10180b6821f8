// SPDX-License-Identifier: Apache-2.0
#include "tracking/identity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/noise.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

using testing::append_seen;
using testing::lone_look;

constexpr double kOwnVariance_m2 = 0.04;
/// What looks at one object from several sides differ by, per axis, of the difference of two.
constexpr double kOneObject_m2 = 2.0 * 0.15 * 0.15;
constexpr double kOneHeight_m2 = 2.0 * 0.5 * 0.5;

/// Objects whose looks share no error: only their own noise and that of the frames is in question.
class TwoTracks : public ::testing::Test {
 protected:
  TwoTracks() { errors_.drift.cover(VehicleTime{}, 0.5); }

  RestingObject& append(const Eigen::Vector2d& place, int hits = 10,
                        const Eigen::Vector2d& slope = Eigen::Vector2d::Zero()) {
    return append_seen(tracks_, errors_, place, hits, kOwnVariance_m2, slope);
  }

  ArrowheadSolver::Solution solution() {
    return *solver_.solve(tracks_.landmarks(), errors_.prior(), errors_.drift);
  }

  bool may_be_one_of_two() { return may_be_one(tracks_[0], tracks_[1], solution(), noise_, config_); }

  JointTrackerConfig config_;
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{10};
  SettledSums settled_{DriftConfig{}};
  FrameNoise noise_{0.09 * Eigen::Matrix2d::Identity(), 5.0, 1.0};
};

TEST_F(TwoTracks, DifferByTheirOwnNoiseAndThatOfTheFramesThatTheyDoNotShare) {
  RestingObject& a = append({0, 0}, 10);
  RestingObject& b = append({0.5, 0}, 4);
  for (const double apart_s : {0.0, 0.7, 100.0}) {
    a.last_look = VehicleTime{from_seconds(50.0)};
    b.last_look = VehicleTime{from_seconds(50.0 - apart_s)};
    // Of five frames that share their noise, ten looks leave a half and four leave all.
    const double frames = (1.0 - std::exp(-apart_s)) * (0.5 + 1.0) * 0.09;
    const double across = kOwnVariance_m2 / 10.0 + kOwnVariance_m2 / 4.0 + frames + kOneObject_m2;
    const double height = 2.0 * testing::kSigmaGround_m * testing::kSigmaGround_m + kOneHeight_m2;
    const PointMatrix expected = Point(across, across, height).asDiagonal();
    EXPECT_LT((covariance_of_difference(a, b, solution(), noise_) - expected).norm(), 1e-9) << apart_s;
  }
}

/// Each seen along one ray: where it stands on that depends on how high the ground is, which differs between
/// two places.
TEST_F(TwoTracks, DifferByWhatIsNotKnownOfTheirHeights) {
  const Eigen::Vector2d slope_of_a(0.2, -0.1), slope_of_b(-0.05, 0.3);
  RestingObject& a = append({0, 0}, 10, slope_of_a);
  RestingObject& b = append({0.5, 0}, 4, slope_of_b);
  const double pixels = kOwnVariance_m2 / 10.0 + kOwnVariance_m2 / 4.0;
  const double ground = testing::kSigmaGround_m * testing::kSigmaGround_m;
  const Point ray_of_a(slope_of_a.x(), slope_of_a.y(), 1.0), ray_of_b(slope_of_b.x(), slope_of_b.y(), 1.0);
  PointMatrix expected = Point(pixels + kOneObject_m2, pixels + kOneObject_m2, kOneHeight_m2).asDiagonal();
  expected += ground * (ray_of_a * ray_of_a.transpose() + ray_of_b * ray_of_b.transpose());
  EXPECT_LT((covariance_of_difference(a, b, solution(), noise_) - expected).norm(), 1e-9);
  EXPECT_TRUE(may_be_one_of_two());
}

/// Two objects that are seen from one side only: either may be higher and farther, but they are on rays of
/// their own, and no height of theirs brings them together.
TEST_F(TwoTracks, OnRaysBesideEachOtherAreNotOneHoweverHighTheGroundMayBe) {
  const Eigen::Vector2d slope(0.3, 0.0);
  append({0, 0}, 10, slope);
  append({1.2, 0}, 10, slope);
  EXPECT_FALSE(may_be_one_of_two());
}

TEST_F(TwoTracks, MayBeOneWithinTheGate) {
  const double sigma_m = std::sqrt(2.0 * kOwnVariance_m2 / 10.0 + kOneObject_m2);
  const double gate_m = std::sqrt(config_.merge_gate) * sigma_m;
  for (const double share : {0.5, 0.98, 1.02}) {
    TrackTable two(2);
    append_seen(two, errors_, {0, 0}, 10, kOwnVariance_m2);
    append_seen(two, errors_, {0, share * gate_m}, 10, kOwnVariance_m2);
    const auto solution = solver_.solve(two.landmarks(), errors_.prior(), errors_.drift);
    EXPECT_EQ(may_be_one(two[0], two[1], *solution, noise_, config_), share < 1.0);
  }
}

TEST_F(TwoTracks, MayBeOneWithinTheRadiusOnly) {
  append({0, 0});
  append({0.4, 0});
  config_.merge_radius_m = 0.41;
  EXPECT_TRUE(may_be_one_of_two());
  config_.merge_radius_m = 0.39;
  EXPECT_FALSE(may_be_one_of_two());
}

TEST_F(TwoTracks, AreNotOneWhereTheyWereSeenSideBySide) {
  append({0, 0}).neighbours.seen_apart(2);
  append({0.1, 0});
  EXPECT_FALSE(may_be_one_of_two());
}

TEST_F(TwoTracks, AreComparedFromThreeHitsOn) {
  RestingObject& a = append({0, 0});
  RestingObject& b = append({0.1, 0});
  EXPECT_TRUE(may_be_one_of_two());
  a.track.hits = 3;
  b.track.hits = 3;
  EXPECT_TRUE(may_be_one_of_two());
  b.track.hits = 2;
  EXPECT_FALSE(may_be_one_of_two());
  b.track.hits = 3;
  a.track.hits = 2;
  EXPECT_FALSE(may_be_one_of_two());
}

TEST_F(TwoTracks, ThatAreTwoKnownPointsAreTwo) {
  RestingObject& a = append({0, 0});
  RestingObject& b = append({0.1, 0});
  a.is_known = true;
  EXPECT_TRUE(may_be_one_of_two());
  b.is_known = true;
  EXPECT_FALSE(may_be_one_of_two());
}

// --- What a frame tells.

class Neighbourhood : public TwoTracks {
 protected:
  static constexpr double kRadius_m = 1.5;

  /// This frame's look shows the object, that much off from where it was expected.
  void see(RestingObject& object, const Eigen::Vector2d& innovation = {0, 0}) {
    object.is_seen = true;
    object.look = looks_.size();
    looks_.push_back(lone_look(object.track.position_in_enu.mean + innovation, kOwnVariance_m2));
    JointAssociation::Match match;
    match.track = 0;
    match.innovation = innovation;
    match.innovation_covariance = lone_look({0, 0}, kOwnVariance_m2).pixel_noise;
    explanation_.match_of_look.push_back(match);
  }

  void tell() { tell_neighbours_apart(looks_, explanation_, errors_, kRadius_m, tracks_, settled_); }

  void begin_frame() {
    looks_.clear();
    explanation_.match_of_look.clear();
    tracks_.clear_evidence();
  }

  bool are_apart(std::size_t a, std::size_t b) const {
    return tracks_[a].neighbours.are_apart(tracks_[b].track.id);
  }

  std::vector<Look> looks_;
  Explanation explanation_;
};

TEST_F(Neighbourhood, OfTwiceTheRadiusIsToldApartByOneFrameThatShowsBoth) {
  see(append({0, 0}));
  see(append({2.9, 0}));
  see(append({-3.1, 0}));
  append({0, 1});
  tell();
  EXPECT_TRUE(are_apart(0, 1));
  EXPECT_TRUE(are_apart(1, 0));
  EXPECT_FALSE(are_apart(0, 2));
  EXPECT_FALSE(are_apart(2, 0));
  EXPECT_FALSE(are_apart(0, 3));
  EXPECT_FALSE(are_apart(3, 0));
  EXPECT_FALSE(are_apart(0, 0));
}

TEST_F(Neighbourhood, IsDoubtedWhereOneOfTwoThatShouldBeSeenIsNot) {
  for (const double probability : {0.5, 0.0}) {
    TrackTable tracks(4);
    for (const double east : {0.0, 1.0}) {
      RestingObject& object = append_seen(tracks, errors_, {east, 0.0}, 5, kOwnVariance_m2);
      object.neighbours.seen_apart(object.track.id == 1 ? 2 : 1);
    }
    tracks[0].is_seen = true;
    tracks[0].look = 0;
    tracks[1].detection_probability = probability;
    const std::vector<Look> looks{lone_look({0, 0}, kOwnVariance_m2)};
    JointAssociation::Match match;
    match.innovation.setZero();
    match.innovation_covariance.setZero();
    Explanation explanation;
    explanation.match_of_look.push_back(match);
    for (int frame = 0; frame < 3; ++frame)
      tell_neighbours_apart(looks, explanation, errors_, kRadius_m, tracks, settled_);
    EXPECT_EQ(tracks[0].neighbours.are_apart(2), probability == 0.0);
    EXPECT_EQ(tracks[1].neighbours.are_apart(1), probability == 0.0);
  }
}

/// The older of two whose looks are all drawn by as much to a side; after so many frames it begins anew or
/// not.
class DrawnAside : public Neighbourhood {
 protected:
  int looks_until_it_begins_anew(const Eigen::Vector2d& innovation, int frames = 20) {
    RestingObject& older = append({0, 0}, 50);
    RestingObject& younger = append({-0.5, 0}, 50);
    for (int frame = 1; frame <= frames; ++frame) {
      begin_frame();
      see(older, innovation);
      see(younger);
      tell();
      if (older.pixel_information(0, 0) < 1.5 / kOwnVariance_m2) return frame;
    }
    return 0;
  }
};

TEST_F(DrawnAside, BeginsAnewFromThePresentLook) {
  EXPECT_EQ(looks_until_it_begins_anew({0.8, 0.0}), 5);
  EXPECT_LT((tracks_[0].track.position_in_enu.mean - Eigen::Vector2d(0.8, 0.0)).norm(), 1e-9);
  EXPECT_LT(
      (tracks_[0].track.position_in_enu.covariance - kOwnVariance_m2 * Eigen::Matrix2d::Identity()).norm(),
      1e-9);
  EXPECT_EQ(tracks_[0].mixture.looks, 0);
  EXPECT_EQ(tracks_[1].mixture.looks, 0);  // of the two the older one is in question
}

/// The mean of n looks beyond their noise by chi-square 13.8 and by a tenth of a metre.
TEST_F(DrawnAside, IsTheSurerTheMoreLooksThereAre) {
  const double drawn_m = 0.5;
  const int needed = static_cast<int>(std::ceil(13.8 * 2.0 * kOwnVariance_m2 / (drawn_m * drawn_m - 0.01)));
  ASSERT_EQ(needed, 5);
  EXPECT_EQ(looks_until_it_begins_anew({drawn_m, 0.0}), 5);
}

TEST_F(DrawnAside, TakesTenLooksAtAThirdOfAMetre) {
  const double drawn_m = 0.35;
  const int needed = static_cast<int>(std::ceil(13.8 * 2.0 * kOwnVariance_m2 / (drawn_m * drawn_m - 0.01)));
  EXPECT_EQ(looks_until_it_begins_anew({drawn_m, 0.0}), needed);
  EXPECT_EQ(needed, 10);
}

TEST_F(DrawnAside, ByLessThanATenthOfAMetreIsNot) {
  EXPECT_EQ(looks_until_it_begins_anew({0.099, 0.0}, 500), 0);
}

TEST_F(DrawnAside, TowardsTheNeighbourIsNot) {
  EXPECT_EQ(looks_until_it_begins_anew({-0.8, 0.0}), 0);
}

TEST_F(DrawnAside, WithinFortyFiveDegreesOfTheLineAwayIs) {
  EXPECT_EQ(looks_until_it_begins_anew({0.8 * 0.75, 0.8 * std::sqrt(1.0 - 0.75 * 0.75)}), 5);
}

TEST_F(DrawnAside, AcrossTheLineAwayIsNot) {
  EXPECT_EQ(looks_until_it_begins_anew({0.8 * 0.65, 0.8 * std::sqrt(1.0 - 0.65 * 0.65)}), 0);
}

TEST_F(DrawnAside, OfAKnownPointIsNot) {
  RestingObject& older = append({0, 0}, 50);
  older.is_known = true;
  RestingObject& younger = append({-0.5, 0}, 50);
  for (int frame = 0; frame < 20; ++frame) {
    begin_frame();
    see(older, {0.8, 0.0});
    see(younger);
    tell();
  }
  EXPECT_EQ(older.mixture.looks, 0);
  EXPECT_NEAR(older.pixel_information(0, 0), 50.0 / kOwnVariance_m2, 1e-6);
}

TEST_F(DrawnAside, OfATrackThatTheLookBeganIsNot) {
  RestingObject& older = append({0, 0}, 50);
  RestingObject& younger = append({-0.5, 0}, 50);
  for (int frame = 0; frame < 20; ++frame) {
    begin_frame();
    see(older, {0.8, 0.0});
    explanation_.match_of_look.back().track.reset();
    see(younger);
    tell();
  }
  EXPECT_EQ(older.mixture.looks, 0);
}

}  // namespace
}  // namespace geoloc
