// SPDX-License-Identifier: Apache-2.0
#include "tracking/known_point_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace geoloc {
namespace {

constexpr double kMatchGate = 11.8, kMatchAmbiguity = 9.0;
const LocalFrame kSurveyFrame({-22.906, -43.133});
const GroundModel kLevel(3.0);

KnownPoint point_at(const Eigen::Vector2d& position_in_enu) {
  KnownPoint point;
  point.position = kSurveyFrame.to_geodetic(position_in_enu);
  return point;
}

constexpr double kFoundByAFrame = 0.7;

VehicleTime at_flight_s(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

/// Frames seconds apart, of all places or of some of them.
template <typename IsCovered>
void cover(KnownPointMatcher& known, double begin_s, int frames, const IsCovered& is_covered) {
  for (int frame = 0; frame < frames; ++frame)
    known.cover(kSurveyFrame, kLevel, at_flight_s(begin_s + 2.0 * frame), kFoundByAFrame, is_covered);
}

void cover(KnownPointMatcher& known, int frames) {
  cover(known, 1000.0, frames, [](const Eigen::Vector3d&) { return true; });
}

/// Looked at long enough.
KnownPointMatcher covered(const std::vector<KnownPoint>& points) {
  KnownPointMatcher known(points, 10);
  cover(known, 30);
  return known;
}

constexpr double kOwn_m = 0.1;

KnownPointMatcher::Candidate object(std::uint64_t id, const Eigen::Vector2d& position_in_enu,
                                    double own_sigma_m = kOwn_m) {
  return {id, true, 0, position_in_enu, own_sigma_m};
}

/// As several solutions do it that say the same.
bool match(KnownPointMatcher& known, const std::vector<KnownPointMatcher::Candidate>& candidates,
           double shared_sigma_m = 0.5) {
  bool is_new = false;
  for (int solution = 0; solution < 3; ++solution)
    is_new = known.match(candidates, shared_sigma_m, kMatchGate, kMatchAmbiguity) || is_new;
  return is_new;
}

TEST(KnownPoints, AreMatchedToTheObjectsThatAreAllOffByTheSame) {
  KnownPointMatcher known = covered({point_at({0, 0}), point_at({20, 0})});
  // Each point has a neighbour that is nearer to it than its own object, 0.7 m east.
  EXPECT_TRUE(match(known, {object(1, {0.7, 0.0}), object(2, {-0.5, 0.0}), object(3, {20.7, 0.0}),
                            object(4, {20.0, 0.6})}));
  EXPECT_EQ(known.matches()[0].track_id, 1U);
  EXPECT_EQ(known.matches()[1].track_id, 3U);
  ASSERT_TRUE(known.survey_of(3));
  EXPECT_LT((known.survey_of(3)->position_in_enu - Eigen::Vector2d(20, 0)).norm(), 1e-6);
  EXPECT_EQ(known.survey_of(3)->sigma_m, KnownPoint{}.sigma_m);
  EXPECT_FALSE(known.survey_of(2));
}

TEST(KnownPoints, SayWhereTheirObjectsAreAndNothingOfTheirHeights) {
  const PointInformation information = KnownPointMatcher::Survey{{20.0, -7.0}, 0.5}.information();
  EXPECT_EQ(information.matrix, PointMatrix(Point(4.0, 4.0, 0.0).asDiagonal()));
  EXPECT_EQ(information.vector, Point(80.0, -28.0, 0.0));
}

/// 7 m and 4 m above anything: on level ground they stand 1.5 m above and below it. A third one without a
/// height says nothing.
TEST(KnownPoints, WithHeightsStandOnTheGroundInTheMean) {
  KnownPoint high = point_at({0, 0}), low = point_at({20, 0});
  high.height_m = 1007.0;
  low.height_m = 1004.0;
  high.sigma_height_m = low.sigma_height_m = 0.1;
  KnownPointMatcher known = covered({high, low, point_at({40, 0})});
  ASSERT_TRUE(match(known, {object(1, {0, 0}), object(2, {20, 0}), object(3, {40, 0})}));
  const PointInformation of_high = known.survey_of(1)->information();
  const PointInformation of_low = known.survey_of(2)->information();
  EXPECT_NEAR(of_high.matrix(2, 2), 100.0, 1e-9);
  EXPECT_NEAR(of_high.vector.z(), 150.0, 1e-9);
  EXPECT_NEAR(of_low.vector.z(), -150.0, 1e-9);
  EXPECT_EQ(known.survey_of(3)->information().matrix(2, 2), 0.0);
}

TEST(KnownPoints, ThatContradictEachOtherAreNotBelieved) {
  KnownPointMatcher known = covered({point_at({0, 0}), point_at({20, 0})});
  EXPECT_FALSE(match(known, {object(1, {0.8, 0.0}), object(2, {19.0, 0.0})}));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kAmbiguous);
  EXPECT_EQ(known.matches()[1].status, KnownPointStatus::kAmbiguous);
}

TEST(KnownPoints, AreReportedWhereNoObjectIs) {
  KnownPointMatcher known = covered({point_at({0, 0}), point_at({40, 0})});
  EXPECT_TRUE(match(known, {object(7, {0.3, 0.0})}));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kMatched);
  EXPECT_EQ(known.matches()[1].status, KnownPointStatus::kNoObject);
}

/// Two stills, or half a second of a stream, whose frames share what hides an object: where nothing else
/// stands near.
TEST(KnownPoints, WaitUntilTheirObjectsWouldHaveBeenFound) {
  const std::vector<KnownPointMatcher::Candidate> candidates{object(7, {0.1, 0.0}), object(8, {20.1, 0.0})};
  const auto is_west = [](const Eigen::Vector3d& place) { return place.x() < 10.0; };
  for (const double period_s : {0.1, 0.5, 5.0}) {
    KnownPointMatcher known({point_at({0, 0}), point_at({20, 0})}, 10);
    EXPECT_FALSE(match(known, candidates));
    EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kNotCovered);
    int frames = 0;
    do {
      known.cover(kSurveyFrame, kLevel, at_flight_s(period_s * frames++), kFoundByAFrame, is_west);
    } while (!match(known, candidates) && frames < 100);
    const double looks = 1.0 + (frames - 1) * std::min(1.0, period_s);
    EXPECT_GT(looks, 1.0) << period_s;
    EXPECT_LE(looks, 2.0) << period_s;
    EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kMatched);
    EXPECT_EQ(known.matches()[1].status, KnownPointStatus::kNotCovered);
  }
}

/// Either of two neighbours, a metre from where one was surveyed: what they share is known to 0.5 m.
TEST(KnownPoints, AreNotMatchedWhereAnotherObjectIsNearlyAsLikely) {
  for (const double own_m : {0.05, 0.5}) {
    for (const double shared_m : {0.0, 0.5}) {
      KnownPointMatcher known = covered({point_at({0, 0})});
      EXPECT_FALSE(match(known, {object(7, {0.5, 0.0}, own_m), object(8, {-0.7, 0.0}, own_m)},
                         std::max(shared_m, 0.5 - own_m)));
      EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kAmbiguous) << own_m << ' ' << shared_m;
    }
  }
}

/// The other one is nearly as likely, though it alone would be too far away.
TEST(KnownPoints, AreNotMatchedWhereAnotherObjectIsJustBeyondTheGate) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  const double near_m = 0.80, far_m = -0.97, shared_m = 0.25;
  ASSERT_LT(near_m * near_m / (shared_m * shared_m + kOwn_m * kOwn_m), kMatchGate);
  ASSERT_GT(far_m * far_m / (shared_m * shared_m + kOwn_m * kOwn_m), kMatchGate);
  EXPECT_FALSE(match(known, {object(7, {near_m, 0.0}), object(8, {far_m, 0.0})}, shared_m));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kAmbiguous);
}

TEST(KnownPoints, AreNotMatchedWhereAnObjectThatIsHardlyKnownMayStandThere) {
  const auto match_beside = [](double own_sigma_m) {
    KnownPointMatcher known = covered({point_at({0, 0})});
    return match(known, {object(7, {0.3, 0.0}), object(8, {1.5, 0.0}, own_sigma_m)}, 0.3);
  };
  EXPECT_TRUE(match_beside(0.1));
  EXPECT_FALSE(match_beside(1.0));
}

TEST(KnownPoints, WaitUntilSeveralSolutionsSayTheSame) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  const auto match_once = [&](std::uint64_t id) {
    return known.match({object(id, {0.1, 0.0})}, 0.5, kMatchGate, kMatchAmbiguity);
  };
  EXPECT_FALSE(match_once(7));
  EXPECT_FALSE(match_once(7));
  EXPECT_FALSE(match_once(8));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kAmbiguous);
  EXPECT_FALSE(match_once(8));
  EXPECT_FALSE(known.match({}, 0.5, kMatchGate, kMatchAmbiguity));
  EXPECT_FALSE(match_once(8));
  EXPECT_FALSE(match_once(8));
  EXPECT_TRUE(match_once(8));
}

/// The object may have been deleted: that it was seen long ago says nothing.
TEST(KnownPoints, WhoseObjectIsGoneAreFoundAgainLikeNewOnes) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  ASSERT_TRUE(match(known, {object(7, {0.1, 0.0})}));
  known.forget(7);
  EXPECT_FALSE(match(known, {object(9, {0.6, 0.0})}));
  cover(known, 30);
  EXPECT_TRUE(match(known, {object(9, {0.6, 0.0})}));
}

TEST(KnownPoints, AreMatchedOnce) {
  KnownPointMatcher known({point_at({0, 0}), point_at({20, 0})}, 10);
  cover(known, 0.0, 1, [](const Eigen::Vector3d&) { return false; });
  cover(known, 2.0, 20, [](const Eigen::Vector3d& place) { return place.x() < 10.0; });
  const std::vector<KnownPointMatcher::Candidate> candidates{object(7, {0.1, 0.0}), object(8, {20.1, 0.0})};
  EXPECT_TRUE(match(known, candidates));
  EXPECT_FALSE(match(known, candidates));
  cover(known, 20);
  EXPECT_TRUE(match(known, candidates));
  EXPECT_EQ(known.matches()[0].track_id, 7U);
  EXPECT_EQ(known.matches()[1].track_id, 8U);
}

/// The object of one point may not be taken for another's, though it is the nearest one there.
TEST(KnownPoints, DoNotShareAnObject) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  ASSERT_TRUE(match(known, {object(7, {0.1, 0.0})}));
  KnownPointMatcher two({point_at({0, 0}), point_at({0.6, 0})}, 10);
  cover(two, 0.0, 20, [](const Eigen::Vector3d& place) { return place.x() < 0.3; });
  ASSERT_TRUE(match(two, {object(7, {0.1, 0.0})}));
  cover(two, 20);
  EXPECT_FALSE(match(two, {object(7, {0.1, 0.0})}));
  EXPECT_EQ(two.matches()[1].status, KnownPointStatus::kNoObject);
}

TEST(KnownPoints, AreOfTheirClass) {
  KnownPoint point = point_at({0, 0});
  point.class_id = 2;
  KnownPointMatcher known = covered({point});
  EXPECT_FALSE(match(known, {object(7, {0.1, 0.0})}));
  EXPECT_TRUE(match(known, {object(7, {0.1, 0.0}), {8, true, 2, {0.4, 0.0}, kOwn_m}}));
  EXPECT_EQ(known.matches()[0].track_id, 8U);
}

TEST(KnownPoints, AreNotMatchedToWhatMayNotExist) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  EXPECT_FALSE(match(known, {{7, false, 0, {0.1, 0.0}, kOwn_m}}));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kAmbiguous);
}

TEST(KnownPoints, FollowTheirTracks) {
  KnownPointMatcher known = covered({point_at({0, 0})});
  ASSERT_TRUE(match(known, {object(7, {0.1, 0.0})}));
  known.rename(5, 6);  // another's
  EXPECT_TRUE(known.survey_of(7));
  known.rename(7, 3);
  EXPECT_TRUE(known.survey_of(3));
  EXPECT_EQ(known.matches()[0].track_id, 3U);
  known.forget(7);
  EXPECT_TRUE(known.survey_of(3));
  known.forget(3);
  EXPECT_FALSE(known.survey_of(3));
  EXPECT_EQ(known.matches()[0].status, KnownPointStatus::kNotCovered);
  cover(known, 20);
  EXPECT_TRUE(match(known, {object(9, {0.1, 0.0})}));
}

TEST(KnownPoints, NoneAreMatchedToNothing) {
  KnownPointMatcher none({}, 10);
  EXPECT_TRUE(none.is_empty());
  EXPECT_FALSE(match(none, {object(7, {0.1, 0.0})}));
  EXPECT_FALSE(covered({point_at({0, 0})}).is_empty());
}

}  // namespace
}  // namespace geoloc
