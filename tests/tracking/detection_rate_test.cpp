// SPDX-License-Identifier: Apache-2.0
#include "tracking/detection_rate.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

using Outcome = DetectionRate::Outcome;

TEST(DetectionRate, BeginsAsAssumedAndCountsThatAsTwentyLooks) {
  DetectionRate rate(0.9);
  EXPECT_DOUBLE_EQ(rate.probability(), 0.9);
  double found = 18.0, looks = 20.0;
  for (int i = 0; i < 500; ++i) {
    const bool is_found = i % 3 == 0;
    rate.count(is_found ? Outcome::kFound : Outcome::kMissed);
    looks += 1.0;
    found += is_found ? 1.0 : 0.0;
    ASSERT_NEAR(rate.probability(), found / looks, 1e-12);
  }
}

TEST(DetectionRate, IsNeverCertainEitherWay) {
  DetectionRate always(0.9), never(0.9);
  for (int i = 0; i < 5000; ++i) {
    always.count(Outcome::kFound);
    never.count(Outcome::kMissed);
  }
  EXPECT_EQ(always.probability(), 0.98);
  EXPECT_EQ(never.probability(), 0.05);
}

/// It remembers no more than 2000 looks: once half as many of another kind have come, they weigh as much as
/// all before.
TEST(DetectionRate, FollowsWhatChanges) {
  DetectionRate rate(0.9);
  for (int i = 0; i < 100000; ++i) rate.count(i % 10 < 8 ? Outcome::kFound : Outcome::kMissed);
  EXPECT_NEAR(rate.probability(), 0.8, 0.01);
  for (int i = 0; i < 2000; ++i) rate.count(i % 10 < 4 ? Outcome::kFound : Outcome::kMissed);
  EXPECT_LT(rate.probability(), 0.6);
  EXPECT_GT(rate.probability(), 0.45);
}

TEST(DetectionRate, HalvesWhatItRemembersOnceThatIsTwoThousandLooks) {
  DetectionRate rate(0.5);
  for (int i = 0; i < 1980; ++i) rate.count(Outcome::kFound);  // 1990 of 2000
  for (int i = 0; i < 100; ++i) rate.count(Outcome::kMissed);  // the first of them halves
  EXPECT_NEAR(rate.probability(), 995.0 / (2001.0 / 2.0 + 99.0), 1e-12);
}

}  // namespace
}  // namespace geoloc
