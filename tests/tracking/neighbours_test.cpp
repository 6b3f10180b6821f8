// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/neighbours.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace geoloc {
namespace {

TEST(Neighbours, AreApartOnceSeenSideBySide) {
  Neighbours neighbours;
  EXPECT_FALSE(neighbours.are_apart(7));
  neighbours.seen_apart(7);
  EXPECT_TRUE(neighbours.are_apart(7));
  EXPECT_FALSE(neighbours.are_apart(8));
}

TEST(Neighbours, SeenApartOnceAreDoubtedAfterTwoLooksAtOneThing) {
  Neighbours neighbours;
  neighbours.seen_apart(7);
  neighbours.seen_as_one(7);
  EXPECT_TRUE(neighbours.are_apart(7));
  neighbours.seen_as_one(7);
  EXPECT_FALSE(neighbours.are_apart(7));
}

TEST(Neighbours, SeenApartTwiceAreApartForEver) {
  Neighbours neighbours;
  neighbours.seen_apart(7);
  neighbours.seen_apart(7);
  for (int i = 0; i < 1000; ++i) neighbours.seen_as_one(7);
  EXPECT_TRUE(neighbours.are_apart(7));
}

TEST(Neighbours, WhatOneLookAtBothSaysOfOnePairSaysNothingOfAnother) {
  Neighbours neighbours;
  neighbours.seen_apart(7);
  for (int i = 0; i < 10; ++i) neighbours.seen_as_one(8);
  EXPECT_TRUE(neighbours.are_apart(7));
  EXPECT_FALSE(neighbours.are_apart(8));
}

TEST(Neighbours, NeverOweEvidence) {
  Neighbours neighbours;
  neighbours.seen_apart(7);
  for (int i = 0; i < 100; ++i) neighbours.seen_as_one(7);
  neighbours.seen_apart(7);
  EXPECT_TRUE(neighbours.are_apart(7));
}

/// The same rules with a map, which forgets nobody.
TEST(Neighbours, CountAsAMapDoesWhileThereAreNoMoreThanADozen) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint64_t> id(1, 12);
  std::uniform_int_distribution<int> event(0, 3);
  Neighbours neighbours;
  std::map<std::uint64_t, double> evidence;
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t other = id(random);
    if (event(random) == 0 && evidence.size() < 12) {
      neighbours.seen_apart(other);
      evidence[other] += 1.0;
    } else {
      neighbours.seen_as_one(other);
      double& its = evidence[other];
      if (its < 2.0) its = its < 0.25 ? 0.0 : its - 0.25;
    }
    if (evidence[other] == 0.0) evidence.erase(other);
    for (std::uint64_t each = 1; each <= 12; ++each)
      ASSERT_EQ(neighbours.are_apart(each), evidence.count(each) > 0 && evidence[each] > 0.5) << i;
  }
}

TEST(Neighbours, KeepTheStrongestEvidenceWhenThereAreMoreThanADozen) {
  Neighbours neighbours;
  for (std::uint64_t other = 1; other <= 12; ++other) {
    neighbours.seen_apart(other);
    if (other != 5) neighbours.seen_apart(other);
  }
  neighbours.seen_apart(99);
  EXPECT_TRUE(neighbours.are_apart(99));
  for (std::uint64_t other = 1; other <= 12; ++other) {
    EXPECT_EQ(neighbours.are_apart(other), other != 5) << other;
  }
}

TEST(Neighbours, FollowATrackThatIsRenamed) {
  Neighbours neighbours;
  neighbours.seen_apart(7);
  neighbours.seen_apart(3);
  neighbours.rename(7, 3);
  EXPECT_FALSE(neighbours.are_apart(7));
  for (int i = 0; i < 100; ++i) neighbours.seen_as_one(3);  // once as 3 and once as 7: that is proof
  EXPECT_TRUE(neighbours.are_apart(3));
}

TEST(Neighbours, ARenamedTrackThatIsNotOneOfThemChangesNothing) {
  Neighbours neighbours;
  for (std::uint64_t other = 1; other <= 12; ++other) neighbours.seen_apart(other);
  neighbours.rename(50, 60);
  EXPECT_FALSE(neighbours.are_apart(60));
  for (std::uint64_t other = 1; other <= 12; ++other) EXPECT_TRUE(neighbours.are_apart(other));
}

TEST(Neighbours, OfTwoTracksThatAreOneAreThoseOfBoth) {
  Neighbours kept, gone;
  kept.seen_apart(1);
  gone.seen_apart(1);
  gone.seen_apart(2);
  kept.merge(gone);
  for (int i = 0; i < 100; ++i) kept.seen_as_one(1);
  EXPECT_TRUE(kept.are_apart(1));
  EXPECT_TRUE(kept.are_apart(2));
  kept.seen_as_one(2);
  kept.seen_as_one(2);
  EXPECT_FALSE(kept.are_apart(2));
}

}  // namespace
}  // namespace geoloc
