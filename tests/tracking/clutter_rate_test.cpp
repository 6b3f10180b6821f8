// SPDX-License-Identifier: Apache-2.0
#include "tracking/clutter_rate.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

TEST(ClutterRate, BeginsAsAssumedAndCountsThatAsFiftyFrames) {
  ClutterRate rate(0.1);
  EXPECT_DOUBLE_EQ(rate.per_frame(), 0.1);
  double boxes = 5.0, frames = 50.0;
  for (int i = 0; i < 500; ++i) {
    rate.count_frame();
    frames += 1.0;
    if (i % 7 == 0) {
      rate.count_false(3);
      boxes += 3.0;
    }
    ASSERT_NEAR(rate.per_frame(), boxes / frames, 1e-12);
  }
}

/// It remembers no more than 1000 frames.
TEST(ClutterRate, FollowsWhatChanges) {
  ClutterRate rate(0.1);
  const auto fly = [&](int frames, int boxes_per_frame) {
    for (int i = 0; i < frames; ++i) {
      rate.count_frame();
      rate.count_false(boxes_per_frame);
    }
  };
  fly(100000, 2);
  EXPECT_NEAR(rate.per_frame(), 2.0, 0.01);
  fly(3000, 0);
  EXPECT_LT(rate.per_frame(), 0.2);
  fly(100000, 0);
  EXPECT_GE(rate.per_frame(), 0.0);
}

/// A look that shows nothing known is of something new, or clutter: by Bayes' rule, where new objects are as
/// frequent as ever and false boxes n times as frequent.
TEST(ClutterRate, OfMoreFalseBoxesFewerAreNewObjects) {
  for (const double usual : {0.1, 0.3, 0.9}) {
    ClutterRate rate(0.1);
    EXPECT_NEAR(rate.birth_probability(usual), usual, 1e-12);
    double before = usual;
    for (int i = 0; i < 200; ++i) {
      rate.count_frame();
      rate.count_false(2);
      const double times = rate.per_frame() / 0.1;
      ASSERT_NEAR(rate.birth_probability(usual), usual / (usual + times * (1.0 - usual)), 1e-12);
      ASSERT_LT(rate.birth_probability(usual), before);
      before = rate.birth_probability(usual);
    }
  }
}

TEST(ClutterRate, OfFewerFalseBoxesNoMoreAreNewObjects) {
  ClutterRate rate(0.1);
  for (int i = 0; i < 5000; ++i) {
    rate.count_frame();
    ASSERT_NEAR(rate.birth_probability(0.3), 0.3, 1e-12);
  }
  EXPECT_LT(rate.per_frame(), 0.01);
  EXPECT_GT(rate.per_frame(), 0.0);  // something is divided by it
}

}  // namespace
}  // namespace geoloc
