// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_scores.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

constexpr int kMiddle = LatencyScores::kReach;

/// Each latency has ten frames, worth nothing.
LatencyScores indifferent() {
  LatencyScores scores;
  for (int n = 0; n < LatencyScores::kSize; ++n) scores[n].frames = 10;
  return scores;
}

TEST(LatencyScores, ReachAsFarEitherWay) {
  EXPECT_DOUBLE_EQ(LatencyScores::latency_s(kMiddle), 0.0);
  EXPECT_DOUBLE_EQ(LatencyScores::latency_s(0), -LatencyScores::latency_s(LatencyScores::kSize - 1));
  EXPECT_NEAR(LatencyScores::latency_s(kMiddle + 1), LatencyScores::kStep_s, 1e-12);
}

TEST(LatencyScores, OfTheBestIsTheHighestMeanOfPlacesAndPairsTogether) {
  LatencyScores scores = indifferent();
  scores[5].by_places = 30.0;
  scores[9].by_places = 20.0;
  scores[9].by_pairs = 20.0;
  EXPECT_EQ(scores.best(10), 9);
  scores[5].frames = 5;
  EXPECT_EQ(scores.best(5), 5) << "more per frame";
  EXPECT_EQ(scores.best(10), 9) << "of too few frames";
}

TEST(LatencyScores, AreCompleteOnceTheLatestStatesAreKnown) {
  LatencyScores scores = indifferent();
  EXPECT_TRUE(scores.are_complete(10));
  scores[0].frames = 9;
  EXPECT_FALSE(scores.are_complete(10));
}

TEST(LatencyScores, HaveOnePeakWhereAllThatAreNearlyAsGoodLieInARow) {
  LatencyScores scores = indifferent();
  scores[20].by_places = 100.0;
  scores[19].by_places = scores[21].by_places = scores[22].by_places = 95.0;
  const auto peak = scores.only_peak(20, 1.0);
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->first, 19);
  EXPECT_EQ(peak->last, 22);
  EXPECT_NEAR(peak->half_width_s(), 2.0 * LatencyScores::kStep_s, 1e-12);
  scores[60].by_places = 95.0;
  EXPECT_FALSE(scores.only_peak(20, 1.0)) << "another explains the frames nearly as well";
  EXPECT_TRUE(scores.only_peak(20, 0.4));
}

}  // namespace
}  // namespace geoloc
