// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/known_points.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

constexpr double kMatchGate = 11.8, kMatchAmbiguity = 9.0;
const LocalFrame kFrame({-22.906, -43.133});

KnownPoint point_at(const Eigen::Vector2d& position_in_enu) {
  KnownPoint point;
  point.position = kFrame.to_geodetic(position_in_enu);
  return point;
}

/// Looked at long enough.
KnownPoints covered(const std::vector<KnownPoint>& points) {
  KnownPoints known(points, 10);
  known.place(kFrame);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int frame = 0; frame < 30; ++frame) known.cover(i);
  }
  return known;
}

bool match(KnownPoints& known, const std::vector<KnownPoints::Candidate>& candidates) {
  constexpr double kShared_m = 0.5, kOwn_m = 0.1;
  return known.match(candidates, kShared_m, kOwn_m, kMatchGate, kMatchAmbiguity);
}

TEST(KnownPoints, AreMatchedToTheObjectsThatAreAllOffByTheSame) {
  KnownPoints known = covered({point_at({0, 0}), point_at({20, 0})});
  // Each point has a neighbour that is nearer to it than its own object, 0.7 m east.
  EXPECT_TRUE(match(known, {{1, true, 0, {0.7, 0.0}},
                            {2, true, 0, {-0.5, 0.0}},
                            {3, true, 0, {20.7, 0.0}},
                            {4, true, 0, {20.0, 0.6}}}));
  EXPECT_EQ(known.entries()[0].track_id, 1U);
  EXPECT_EQ(known.entries()[1].track_id, 3U);
  EXPECT_EQ(known.of_track(3), &known.entries()[1]);
}

TEST(KnownPoints, ThatContradictEachOtherAreNotBelieved) {
  KnownPoints known = covered({point_at({0, 0}), point_at({20, 0})});
  EXPECT_FALSE(match(known, {{1, true, 0, {0.8, 0.0}}, {2, true, 0, {19.0, 0.0}}}));
  EXPECT_EQ(known.entries()[0].status, KnownPointStatus::kAmbiguous);
  EXPECT_EQ(known.entries()[1].status, KnownPointStatus::kAmbiguous);
}

TEST(KnownPoints, AreReportedWhereNoObjectIs) {
  KnownPoints known = covered({point_at({0, 0}), point_at({40, 0})});
  EXPECT_TRUE(match(known, {{7, true, 0, {0.3, 0.0}}}));
  EXPECT_EQ(known.entries()[0].status, KnownPointStatus::kMatched);
  EXPECT_EQ(known.entries()[1].status, KnownPointStatus::kNoObject);
}

TEST(KnownPoints, WaitUntilTheCameraHasLooked) {
  KnownPoints known({point_at({0, 0})}, 10);
  known.place(kFrame);
  EXPECT_FALSE(match(known, {{7, true, 0, {0.1, 0.0}}}));
  EXPECT_EQ(known.entries()[0].status, KnownPointStatus::kNotCovered);
}

TEST(KnownPoints, AreOfTheirClass) {
  KnownPoint point = point_at({0, 0});
  point.class_id = 2;
  KnownPoints known = covered({point});
  EXPECT_FALSE(match(known, {{7, true, 0, {0.1, 0.0}}}));
  EXPECT_TRUE(match(known, {{7, true, 0, {0.1, 0.0}}, {8, true, 2, {0.4, 0.0}}}));
  EXPECT_EQ(known.entries()[0].track_id, 8U);
}

TEST(KnownPoints, AreNotMatchedToWhatMayNotExist) {
  KnownPoints known = covered({point_at({0, 0})});
  EXPECT_FALSE(match(known, {{7, false, 0, {0.1, 0.0}}}));
  EXPECT_EQ(known.entries()[0].status, KnownPointStatus::kAmbiguous);
}

TEST(KnownPoints, FollowTheirTracks) {
  KnownPoints known = covered({point_at({0, 0})});
  ASSERT_TRUE(match(known, {{7, true, 0, {0.1, 0.0}}}));
  known.rename(7, 3);
  EXPECT_NE(known.of_track(3), nullptr);
  known.forget(3);
  EXPECT_EQ(known.of_track(3), nullptr);
  EXPECT_TRUE(match(known, {{9, true, 0, {0.1, 0.0}}}));
}

}  // namespace
}  // namespace geoloc
