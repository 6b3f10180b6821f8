// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/class_votes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace geoloc {
namespace {

TEST(ClassVotes, MajorityWinsWhateverTheOrder) {
  for (const int first : {0, 3}) {
    ClassVotes votes;
    for (int i = 0; i < 100; ++i) votes.add(i % 10 < 6 ? first : 10 + i % 7, 0.8);
    EXPECT_EQ(votes.winner(), first);
  }
}

TEST(ClassVotes, WeighConfidences) {
  ClassVotes votes;
  for (int i = 0; i < 3; ++i) votes.add(1, 0.3);
  votes.add(2, 1.0);
  EXPECT_EQ(votes.winner(), 2);
}

TEST(ClassVotes, OfEqualWeightGoToTheSmallerId) {
  for (const bool smaller_first : {true, false}) {
    ClassVotes votes;
    votes.add(smaller_first ? 4 : 9, 0.5);
    votes.add(smaller_first ? 9 : 4, 0.5);
    EXPECT_EQ(votes.winner(), 4);
  }
}

TEST(ClassVotes, OfFourClassesAreCountedExactly) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0.1, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    ClassVotes votes;
    std::vector<double> sums(4, 0.0);
    for (int i = 0; i < 30; ++i) {
      const int id = static_cast<int>(random() % 4);
      const double given = weight(random);
      votes.add(id, given);
      sums[static_cast<std::size_t>(id)] += given;
    }
    EXPECT_EQ(votes.winner(), std::max_element(sums.begin(), sums.end()) - sums.begin());
  }
}

/// Misra and Gries: with four counters no class loses more than a fifth of all votes, here 12.
TEST(ClassVotes, AClassThatReturnsWinsAmongAnyNumberOfOthersThatDoNot) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<int> ids;
    for (int i = 0; i < 60; ++i) ids.push_back(i < 25 ? 500 : 1000 + i);  // 25 votes against 35 lone ones
    std::shuffle(ids.begin(), ids.end(), random);
    ClassVotes votes;
    for (const int id : ids) votes.add(id, 0.7);
    EXPECT_EQ(votes.winner(), 500);
  }
}

TEST(ClassVotes, AWeakNewcomerTakesItsWeightFromAllAndAStrongOneTakesThePlaceOfTheWeakest) {
  ClassVotes votes;
  votes.add(1, 1.0);
  votes.add(2, 0.9);
  votes.add(3, 0.8);
  votes.add(4, 0.5);
  votes.add(5, 0.45);  // 1: 0.55, 2: 0.45, 3: 0.35, 4: 0.05
  votes.add(6, 0.2);   // in the place of 4: 1: 0.5, 2: 0.4, 3: 0.3, 6: 0.2
  votes.add(6, 0.25);  // 0.45
  EXPECT_EQ(votes.winner(), 1);
  votes.add(6, 0.1);
  EXPECT_EQ(votes.winner(), 6);
}

TEST(ClassVotes, AreKeptThroughAMerge) {
  ClassVotes a, b;
  a.add(1, 2.0);
  b.add(2, 1.5);
  b.add(1, 0.1);
  a.add(b);
  EXPECT_EQ(a.winner(), 1);
  a.add(b);
  EXPECT_EQ(a.winner(), 2);  // 2.2 against 3.0
}

TEST(ClassVotes, NoneGiveClassZero) {
  EXPECT_EQ(ClassVotes{}.winner(), 0);
}

}  // namespace
}  // namespace geoloc
