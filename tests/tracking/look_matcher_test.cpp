// SPDX-License-Identifier: Apache-2.0
#include "tracking/look_matcher.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/noise.hpp"
#include "geoloc/geometry/angles.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

using testing::append_seen;
using testing::lone_look;

constexpr double kVariance_m2 = 0.01;
/// -2 ln of the density of one new object in the image, but for the 2 pi.
const double kCostAlone = -2.0 * std::log(2.0 * kPi * testing::kOnePerImage);
/// The same of looks that may as well be of something new.
const double kCostOfDoubt = kCostAlone - 2.0;
/// A frame that is shaken has so much more noise, and is so much less probable than one that is not; and an
/// object that only the shaken frame shows was missed otherwise, which is improbable too.
constexpr double kShake = 4.0, kCostOfShake = 6.0, kCostMissed = 4.6;

/// Objects that many looks have shown, whose looks and tracks share no error but the frame's.
class MatchedLooks : public ::testing::Test {
 protected:
  MatchedLooks() { errors_.drift.cover(VehicleTime{}, 0.5); }

  RestingObject& append(const Eigen::Vector2d& place, int hits = 100) {
    RestingObject& object = append_seen(tracks_, errors_, place, hits, kVariance_m2);
    object.last_look = now_;
    return object;
  }

  /// Looks at places, of a class each.
  const Explanation& explain(const std::vector<Eigen::Vector2d>& places, int class_id = 0) {
    looks_.clear();
    for (const Eigen::Vector2d& place : places) {
      looks_.push_back(lone_look(place, kVariance_m2));
      looks_.back().detection.class_id = class_id;
      looks_.back().jacobian.middleCols<2>(SharedError::kFrame) =
          frame_sigma_m_ * Eigen::Matrix2d::Identity();
    }
    tracks_.clear_evidence();
    noise_.covariance = frame_sigma_m_ * frame_sigma_m_ * Eigen::Matrix2d::Identity();
    return matcher_.explain(looks_, noise_, tracks_);
  }

  std::optional<std::size_t> track_of_only_look(const Eigen::Vector2d& place, int class_id = 0) {
    return explain({place}, class_id).match_of_look[0].track;
  }

  JointTrackerConfig config_;
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{20};
  LookMatcher matcher_{config_, 20};
  FrameNoise noise_{Eigen::Matrix2d::Zero(), 1.0, 1.0};
  double frame_sigma_m_ = 0.0;
  VehicleTime now_{from_seconds(100.0)};
  std::vector<Look> looks_;
};

TEST_F(MatchedLooks, ShowTheTrackAtTheirPlace) {
  append({0, 0});
  append({5, 0});
  const Explanation& explanation = explain({{5.1, 0.0}, {20.0, 0.0}});
  EXPECT_EQ(explanation.match_of_look[0].track, 1U);
  EXPECT_TRUE(explanation.match_of_look[0].is_certain());
  EXPECT_FALSE(explanation.match_of_look[1].track);
  EXPECT_FALSE(tracks_[0].is_seen);
  EXPECT_FALSE(tracks_[0].look);
  EXPECT_TRUE(tracks_[1].is_seen);
  EXPECT_EQ(tracks_[1].look, 0U);
  EXPECT_FALSE(tracks_[1].is_in_doubt);
}

/// Where a look is left alone: the noise of look and track, and of the frame, of which the track has what its
/// frames left in it. Beyond that gate, a frame that shows only this may have been shaken.
TEST_F(MatchedLooks, ReachAsFarAsTheirNoiseDoesAndThatOfAShakenFrame) {
  constexpr double kFrameVariance_m2 = 0.09;
  for (const int hits : {1, 4, 100}) {
    TrackTable tracks(1);
    append_seen(tracks, errors_, {0, 0}, hits, kVariance_m2);
    const FrameNoise noise{kFrameVariance_m2 * Eigen::Matrix2d::Identity(), 8.0, 1.0};
    const double own = kVariance_m2 + kVariance_m2 / hits + std::min(1.0, 8.0 / hits) * kFrameVariance_m2;
    const double calm = own + kFrameVariance_m2, shaken = own + kShake * kShake * kFrameVariance_m2;
    const double of_shaken = kCostAlone - kCostOfShake + kCostMissed - 2.0 * std::log(shaken);
    const double reach_m =
        std::sqrt(std::max(config_.gate * calm, std::min(config_.gate, of_shaken) * shaken));
    EXPECT_GT(reach_m, 1.05 * std::sqrt(config_.gate * calm));
    for (const double share : {0.1, 0.5, 0.98, 1.02, 1.5}) {
      Look look = lone_look({0.0, share * reach_m}, kVariance_m2);
      look.jacobian.middleCols<2>(SharedError::kFrame) =
          std::sqrt(kFrameVariance_m2) * Eigen::Matrix2d::Identity();
      const Explanation& explanation = matcher_.explain({look}, noise, tracks);
      EXPECT_EQ(explanation.match_of_look[0].track.has_value() || tracks[0].is_in_doubt, share < 1.0)
          << hits << " hits, " << share;
      tracks.clear_evidence();
    }
  }
}

/// How long a track was not seen says nothing of the noise of this frame.
TEST_F(MatchedLooks, ReachAsFarHoweverLongAgoTheTrackWasSeen) {
  frame_sigma_m_ = 0.3;
  RestingObject& object = append({0, 0});
  std::vector<Eigen::Matrix2d> covariances;
  for (const double unseen_s : {0.0, 1.0, 50.0}) {
    object.last_look = now_ - from_seconds(unseen_s);
    covariances.push_back(explain({{0.1, 0.0}}).match_of_look[0].innovation_covariance);
  }
  EXPECT_EQ(covariances[0], covariances[1]);
  EXPECT_EQ(covariances[0], covariances[2]);
}

/// Calibration and drift that shift look and track alike cancel; what shifts the one alone does not.
TEST_F(MatchedLooks, ReachAsFarAsWhatShiftsThemAndNotTheTrack) {
  RestingObject& object = append({0, 0});
  SharedError::Row shifted = SharedError::Row::Zero();
  shifted(0, 2) = 0.5;
  for (const bool is_shared : {true, false}) {
    object.sensitivity.setZero();
    if (is_shared) object.sensitivity.topRows<2>() = shifted;
    const double variance = kVariance_m2 * 1.01 + (is_shared ? 0.0 : 0.25);
    for (const double factor : {0.98, 1.02}) {
      Look look = lone_look({factor * std::sqrt(config_.gate * variance), 0.0}, kVariance_m2);
      look.jacobian = shifted;
      tracks_.clear_evidence();
      matcher_.explain({look}, noise_, tracks_);
      EXPECT_EQ(object.is_seen || object.is_in_doubt, factor < 1.0) << is_shared;
    }
  }
}

/// The track was seen along one ray, and the look comes along another: they meet where the ground is as high
/// as expected, and miss each other by what it is not.
TEST_F(MatchedLooks, FromAnotherSideReachAsFarAsTheGroundMayBeHighOrLow) {
  const Eigen::Vector2d slope_of_track(0.3, -0.1);
  for (const Eigen::Vector2d& slope : {Eigen::Vector2d(0.3, -0.1), Eigen::Vector2d(-0.2, 0.1),
                                       Eigen::Vector2d(-0.2, 0.7), Eigen::Vector2d(0.0, 0.0)}) {
    TrackTable tracks(1);
    RestingObject& object = append_seen(tracks, errors_, {0, 0}, 50, kVariance_m2, slope_of_track);
    object.last_look = now_;
    const Eigen::Vector2d ground_m = testing::kSigmaGround_m * (slope_of_track - slope);
    const Eigen::Matrix2d covariance =
        kVariance_m2 * 1.02 * Eigen::Matrix2d::Identity() + ground_m * ground_m.transpose();
    for (const Eigen::Vector2d& direction : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0.6, 0.8)}) {
      const double gate_m =
          std::sqrt(config_.gate / (direction.transpose() * covariance.inverse() * direction).value());
      for (const double factor : {0.98, 1.02}) {
        tracks.clear_evidence();
        matcher_.explain({lone_look(factor * gate_m * direction, kVariance_m2, slope)}, noise_, tracks);
        EXPECT_EQ(tracks[0].is_seen || tracks[0].is_in_doubt, factor < 1.0) << slope.transpose();
      }
    }
  }
}

/// An object on a hill, whose height two rays have told.
TEST_F(MatchedLooks, ShowAnObjectOnAHillWhereTheirRaysPassIt) {
  const Eigen::Vector3d place(4.0, -3.0, 2.5);
  const auto look_along = [&](const Eigen::Vector2d& slope) {
    return lone_look(place.head<2>() - place.z() * slope, kVariance_m2, slope);
  };
  RestingObject& object = append_seen(tracks_, errors_, {0, 0}, 1, kVariance_m2);
  object.last_look = now_;
  object.prior = testing::ground_at(place.z(), 5.0);
  begin_sums(object, look_along({0.5, 0.2}), errors_);
  for (int i = 0; i < 200; ++i) {
    add_to_sums(object, look_along({0.5, 0.2}), errors_);
    add_to_sums(object, look_along({-0.4, 0.1}), errors_);
  }
  object.track.hits = 401;
  EXPECT_LT((object.position_in_enu - place).norm(), 1e-9);
  for (const Eigen::Vector2d& slope : {Eigen::Vector2d(1.0, -1.0), Eigen::Vector2d(0.0, 0.8)}) {
    tracks_.clear_evidence();
    const Explanation& explanation = matcher_.explain({look_along(slope)}, noise_, tracks_);
    ASSERT_TRUE(explanation.match_of_look[0].is_certain());
    EXPECT_LT(explanation.match_of_look[0].innovation.norm(), 1e-9);
  }
}

/// A height that follows the shared errors moves the track along the look's ray: what the look itself does
/// of that cancels.
TEST_F(MatchedLooks, ReachAsFarAsWhatShiftsThemAndNotTheTracksHeight) {
  RestingObject& object = append({0, 0});
  const Eigen::Vector2d slope(0.6, 0.0);
  object.sensitivity(2, 4) = 0.8;
  const double ground_m = slope.x() * testing::kSigmaGround_m;
  for (const bool is_shared : {true, false}) {
    const double variance =
        kVariance_m2 * 1.01 + ground_m * ground_m + (is_shared ? 0.0 : std::pow(slope.x() * 0.8, 2));
    for (const double factor : {0.98, 1.02}) {
      Look look = lone_look({factor * std::sqrt(config_.gate * variance), 0.0}, kVariance_m2, slope);
      if (is_shared) look.jacobian(0, 4) = -slope.x() * 0.8;
      tracks_.clear_evidence();
      matcher_.explain({look}, noise_, tracks_);
      EXPECT_EQ(object.is_seen || object.is_in_doubt, factor < 1.0) << is_shared;
    }
  }
}

/// From a centimetre to a metre.
TEST_F(MatchedLooks, ReachAsFarAsTheDetectorsNoiseDoesOfWhateverSizeItIs) {
  RestingObject& object = append({0, 0});
  for (const double variance : {1e-4, 1e-2, 1.0}) {
    const double gate_m = std::sqrt(config_.gate * (variance + kVariance_m2 / 100.0));
    for (const double factor : {0.98, 1.02}) {
      tracks_.clear_evidence();
      matcher_.explain({lone_look({0.0, factor * gate_m}, variance)}, noise_, tracks_);
      EXPECT_EQ(object.is_seen || object.is_in_doubt, factor < 1.0) << variance;
    }
  }
}

/// The bound that spares most pairs a close look spares none that is within the gate: a random track and look
/// each, beside another track and look that have no part in it but theirs in what all of them follow.
TEST_F(MatchedLooks, AreComparedWithEveryTrackTheyMayShow) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  int within = 0, matched = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    TrackTable tracks(2);
    const auto slope = [&] { return Eigen::Vector2d(0.7 * normal(random), 0.7 * normal(random)); };
    for (const double east : {0.0, 1000.0}) {
      RestingObject& object = append_seen(tracks, errors_, {east, 0.0}, 3, kVariance_m2, slope());
      if (trial % 2 == 0) {  // its height is known, but for what is shared
        object.prior = testing::ground_at(0.0, 0.01);
        begin_sums(object, lone_look({east, 0.0}, kVariance_m2, slope()), errors_);
      }
      object.last_look = now_;
      for (double& value : object.sensitivity.reshaped()) value = 0.3 * normal(random);
      object.sensitivity.row(2) *= 5.0;
    }
    Look look = lone_look({6.0 * normal(random), 6.0 * normal(random)}, kVariance_m2, slope());
    for (double& value : look.jacobian.reshaped()) value = 0.3 * normal(random);
    Look elsewhere = lone_look({-5000.0, 0.0}, kVariance_m2, look.observation.slope);
    elsewhere.jacobian = look.jacobian;
    if (trial % 4 == 0) {  // what moves the one way moves the other the other way, and the tracks not at all
      look.jacobian *= 5.0;
      elsewhere.jacobian = -look.jacobian;
      for (RestingObject& track : tracks) track.sensitivity.setZero();
    }
    Eigen::Matrix<double, 2, 3> H;
    H << 1.0, 0.0, -look.observation.slope.x(), 0.0, 1.0, -look.observation.slope.y();
    SharedError::Row shared = look.jacobian - H * tracks[0].sensitivity;
    const Eigen::Matrix2d covariance =
        look.pixel_noise + H * tracks[0].pixel_covariance * H.transpose() + shared * shared.transpose();
    const Eigen::Vector2d apart = look.position - H * tracks[0].position_in_enu;
    const double distance = apart.dot(covariance.inverse() * apart);
    const double cost = distance + std::log(covariance.determinant());  // of the look at its track
    const auto match = matcher_.explain({look, elsewhere}, noise_, tracks).match_of_look[0];
    const bool is_its = match.track == 0U;
    if (distance > config_.gate) {
      EXPECT_FALSE(is_its || match.is_ambiguous) << trial;
      continue;
    }
    // A pair that is weighed shows: the look is its, or ambiguous.
    EXPECT_EQ(match.is_ambiguous, cost > kCostOfDoubt) << trial;
    EXPECT_EQ(is_its, cost < kCostOfDoubt + config_.ambiguity) << trial;
    ++within;
    matched += is_its ? 1 : 0;
  }
  EXPECT_GT(within, 100);
  EXPECT_LT(within, 900);
  EXPECT_GT(matched, 100);
}

TEST_F(MatchedLooks, OfAnotherClassAreFartherAway) {
  append({0, 0});
  const double sigma_m = std::sqrt(kVariance_m2 * 1.01);
  const auto is_reached = [&](double squared_distance, int class_id) {
    track_of_only_look({std::sqrt(squared_distance) * sigma_m, 0.0}, class_id);
    return tracks_[0].is_seen || tracks_[0].is_in_doubt;
  };
  EXPECT_TRUE(is_reached(config_.gate - 0.2, 0));
  EXPECT_FALSE(is_reached(config_.gate + 0.2, 0));
  EXPECT_TRUE(is_reached(config_.gate - config_.class_mismatch_cost - 0.2, 3));
  EXPECT_FALSE(is_reached(config_.gate - config_.class_mismatch_cost + 0.2, 3));
}

TEST_F(MatchedLooks, AreShiftedByTheirMedian) {
  for (const double east : {0.0, 5.0, 10.0}) append({east, 0});
  const Explanation& explanation = explain({{0.1, 0.02}, {5.15, -0.06}, {10.02, 0.01}, {30.0, 0.0}});
  EXPECT_LT((explanation.common_shift - Eigen::Vector2d(0.1, 0.01)).norm(), 1e-12);
}

TEST_F(MatchedLooks, OfOneTrackTellNoShift) {
  append({0, 0});
  EXPECT_EQ(explain({{0.1, 0.1}, {30.0, 0.0}}).common_shift, Eigen::Vector2d(0.0, 0.0));
  append({5, 0});
  EXPECT_LT((explain({{0.1, 0.1}, {5.2, 0.2}}).common_shift - Eigen::Vector2d(0.2, 0.2)).norm(), 1e-12);
}

TEST_F(MatchedLooks, ThatMayShowEitherOfTwoTellNothingOfThem) {
  frame_sigma_m_ = 0.3;
  append({0, 0});
  append({0.3, 0});
  const Explanation& explanation = explain({{0.15, 0.0}});
  EXPECT_TRUE(explanation.match_of_look[0].is_ambiguous);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_FALSE(tracks_[k].is_seen);
    EXPECT_TRUE(tracks_[k].is_in_doubt);
  }
}

/// Of two tracks at one place, one of which is young, the older one is seen.
class Twins : public MatchedLooks {
 protected:
  Twins() { frame_sigma_m_ = 0.3; }

  /// Whether the look between two is the first track's, certainly.
  bool is_the_firsts(const Eigen::Vector2d& place = {0.15, 0.0}) {
    const auto& match = explain({place}).match_of_look[0];
    return match.is_certain() && match.track == 0U;
  }
};

TEST_F(Twins, AreTheOlderOnesWhileOneIsYoung) {
  RestingObject& older = append({0, 0});
  RestingObject& younger = append({0.3, 0});
  younger.track.hits = 2;
  EXPECT_TRUE(is_the_firsts());
  EXPECT_TRUE(tracks_[0].is_seen);
  EXPECT_FALSE(tracks_[1].is_in_doubt);
  // What the match says is what the pair by itself does.
  const auto match = explain({{0.15, 0.0}}).match_of_look[0];
  EXPECT_LT((match.innovation - Eigen::Vector2d(0.15, 0.0)).norm(), 1e-9);
  younger.track.hits = 3;
  EXPECT_FALSE(is_the_firsts());
  younger.track.hits = 2;
  older.neighbours.seen_apart(younger.track.id);
  EXPECT_FALSE(is_the_firsts());
}

TEST_F(Twins, OlderIsTheConfirmedOneThenTheOneSeenOftenerThenTheFirst) {
  RestingObject& first = append({0, 0});
  RestingObject& second = append({0.3, 0});
  first.last_look = second.last_look = now_ - from_seconds(50.0);  // the frames' noise has changed since
  const auto seen_one = [&]() -> std::optional<std::size_t> {
    const auto& match = explain({{0.15, 0.0}}).match_of_look[0];
    if (!match.is_certain()) return std::nullopt;
    return match.track;
  };
  first.track.hits = second.track.hits = 2;
  EXPECT_EQ(seen_one(), 0U);
  first.track.hits = 1;
  EXPECT_EQ(seen_one(), 1U);
  first.track.status = TrackStatus::kConfirmed;
  EXPECT_EQ(seen_one(), 0U);
}

TEST_F(Twins, AreNotTwinsWhereAnotherLookMayShowThem) {
  append({0, 0});
  append({0.3, 0}).track.hits = 2;
  const Explanation& explanation = explain({{0.15, 0.0}, {0.16, 0.28}});
  EXPECT_FALSE(explanation.match_of_look[0].is_certain());
}

TEST_F(Twins, OfADoubtfulLookAtOneTrackAreNone) {
  append({0, 0});
  const double far_m = std::sqrt(0.9 * config_.gate * (kVariance_m2 + 0.09));
  EXPECT_FALSE(is_the_firsts({far_m, 0.0}));
  EXPECT_TRUE(tracks_[0].is_in_doubt);
}

// --- Shaken frames.

/// Objects ten metres apart, which frames show to two centimetres but for what the frame's looks share.
class ShakenFrames : public MatchedLooks {
 protected:
  static constexpr double kFrameSigma_m = 0.1;

  ShakenFrames() { frame_sigma_m_ = kFrameSigma_m; }

  /// A frame that shows the first `count` objects, all shifted by as much.
  const Explanation& explain_shifted(int count, const Eigen::Vector2d& shift) {
    while (static_cast<int>(tracks_.size()) < count) append(place_of(static_cast<int>(tracks_.size())));
    std::vector<Eigen::Vector2d> places;
    for (int k = 0; k < count; ++k) places.push_back(place_of(k) + shift);
    return explain_precisely(places);
  }

  const Explanation& explain_precisely(const std::vector<Eigen::Vector2d>& places) {
    looks_.clear();
    for (const Eigen::Vector2d& place : places) {
      looks_.push_back(lone_look(place, kPixelVariance_m2));
      looks_.back().jacobian.middleCols<2>(SharedError::kFrame) =
          frame_sigma_m_ * Eigen::Matrix2d::Identity();
    }
    tracks_.clear_evidence();
    noise_.covariance = frame_sigma_m_ * frame_sigma_m_ * Eigen::Matrix2d::Identity();
    return matcher_.explain(looks_, noise_, tracks_);
  }

  static Eigen::Vector2d place_of(int k) {
    const int column = k % 3, row = k / 3;
    return {10.0 * column, 10.0 * row};
  }

  static constexpr double kPixelVariance_m2 = 4e-4;
};

/// By four sigmas, in whatever direction: every look is its object's, which is none of them by the noise that
/// is known.
TEST_F(ShakenFrames, ThatShowSeveralObjectsShowEachWhereAllAreShiftedAlike) {
  for (const int count : {3, 5, 8}) {
    for (double direction = 0.0; direction < 6.2; direction += 0.7) {
      const Eigen::Vector2d shift =
          4.0 * kFrameSigma_m * Eigen::Vector2d(std::cos(direction), std::sin(direction));
      const Explanation& explanation = explain_shifted(count, shift);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        EXPECT_EQ(explanation.match_of_look[i].track, i) << direction;
        EXPECT_TRUE(explanation.match_of_look[i].is_certain()) << direction;
      }
      EXPECT_LT((explanation.common_shift - shift).norm(), 1e-9);
    }
  }
}

/// What is too far for a shaken frame is not seen.
TEST_F(ShakenFrames, DoNotShowWhatIsTwentySigmasAside) {
  const Explanation& explanation = explain_shifted(5, {20.0 * kFrameSigma_m, 0.0});
  for (const auto& match : explanation.match_of_look) EXPECT_FALSE(match.track);
}

/// One object is missed, and something new stands four sigmas beside it: the others say that the frame was
/// calm.
TEST_F(ShakenFrames, AreNotThoseThatShowOneNewObjectBesideTheKnownOnes) {
  for (const int known : {2, 4, 7}) {
    explain_shifted(known + 1, Eigen::Vector2d::Zero());
    std::vector<Eigen::Vector2d> places;
    for (int k = 0; k < known; ++k) places.push_back(place_of(k));
    places.push_back(place_of(known) + Eigen::Vector2d(4.0 * kFrameSigma_m, 0.0));
    const Explanation& explanation = explain_precisely(places);
    for (int k = 0; k < known; ++k) {
      const auto& match = explanation.match_of_look[static_cast<std::size_t>(k)];
      EXPECT_TRUE(match.is_certain());
      EXPECT_EQ(match.track, static_cast<std::size_t>(k));
    }
    EXPECT_FALSE(explanation.match_of_look.back().track) << known;
  }
}

/// What shows a frame to be calm is that it shows the objects where they are: then all that is beside them is
/// new, and matched by the calm frame's noise.
TEST_F(ShakenFrames, AreNotSoughtWhereEveryLookIsAnObjects) {
  const Explanation& explanation = explain_shifted(5, {0.1 * kFrameSigma_m, 0.0});
  for (const auto& match : explanation.match_of_look) {
    ASSERT_TRUE(match.is_certain());
    const double variance = kPixelVariance_m2 + kVariance_m2 / 100.0 + 1.01 * kFrameSigma_m * kFrameSigma_m;
    EXPECT_LT((match.innovation_covariance - variance * Eigen::Matrix2d::Identity()).norm(), 1e-9);
  }
}

/// The pair that a look was explained by is that of the noise it was explained with.
TEST_F(ShakenFrames, AreWhatTheNoiseLearnsFrom) {
  const Eigen::Vector2d shift(0.0, 4.0 * kFrameSigma_m);
  const Explanation& explanation = explain_shifted(5, shift);
  for (std::size_t i = 0; i < 5; ++i) {
    const Pairing& pairing = matcher_.pairing_of(explanation.match_of_look[i]);
    EXPECT_EQ(pairing.look, i);
    EXPECT_EQ(pairing.track, i);
    EXPECT_LT((pairing.residual - shift).norm(), 1e-9);
    const Eigen::Matrix2d frame = pairing.jacobian.middleCols<2>(SharedError::kFrame);
    EXPECT_LT((frame - kShake * kFrameSigma_m * Eigen::Matrix2d::Identity()).norm(), 1e-12);
  }
}

TEST_F(MatchedLooks, OfAnEmptyFrameAreNone) {
  append({0, 0});
  EXPECT_TRUE(explain({}).match_of_look.empty());
  EXPECT_FALSE(tracks_[0].is_seen);
}

}  // namespace
}  // namespace geoloc
