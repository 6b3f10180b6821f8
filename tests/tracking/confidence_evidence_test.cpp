// SPDX-License-Identifier: Apache-2.0
#include "tracking/confidence_evidence.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace geoloc {
namespace {

ConfidenceCounts counts_of(const std::vector<double>& confidences) {
  ConfidenceCounts counts;
  for (const double confidence : confidences) counts.add(confidence);
  return counts;
}

/// Not nearly: results must not depend on what confidences cannot tell.
TEST(ConfidenceEvidence, ConfidencesThatAreAllAlikeSayNothing) {
  for (const double confidence : {0.0, 0.25, 0.87, 1.0}) {
    ConfidenceEvidence evidence;
    for (int i = 0; i < 5000; ++i) {
      EXPECT_EQ(evidence.ratio(confidence), 1.0);
      evidence.count_object(confidence);
      if (i % 3 == 0) evidence.count_false(counts_of({confidence}));
    }
  }
}

TEST(ConfidenceEvidence, OneNeverSeenSaysNothing) {
  ConfidenceEvidence evidence;
  evidence.count_object(0.9);
  evidence.count_false(counts_of({0.3, 0.3}));
  EXPECT_EQ(evidence.ratio(0.6), 1.0);
}

/// Without false boxes, nothing is known of their confidence.
TEST(ConfidenceEvidence, OneKindAloneSaysNothing) {
  ConfidenceEvidence evidence;
  for (const double confidence : {0.3, 0.5, 0.5, 0.9}) evidence.count_object(confidence);
  for (const double confidence : {0.3, 0.5, 0.9}) EXPECT_NEAR(evidence.ratio(confidence), 1.0, 1e-12);
}

TEST(ConfidenceEvidence, AFewBoxesSayLittle) {
  ConfidenceEvidence evidence;
  evidence.count_object(0.9);
  evidence.count_false(counts_of({0.3}));
  EXPECT_LT(evidence.ratio(0.9), 1.11);
  EXPECT_GT(evidence.ratio(0.9), 1.0);
  EXPECT_GT(evidence.ratio(0.3), 0.9);
  EXPECT_LT(evidence.ratio(0.3), 1.0);
}

/// Objects' confidences are drawn between 0.3 and 0.6, false boxes' between 0.25 and 0.35.
TEST(ConfidenceEvidence, OfManyBoxesItIsTheRatioOfTheDensities) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> of_object(0.3, 0.6), of_false(0.25, 0.35);
  ConfidenceEvidence evidence;
  for (int i = 0; i < 1500; ++i) {
    evidence.count_object(of_object(random));
    evidence.count_false(counts_of({of_false(random)}));
  }
  EXPECT_NEAR(evidence.ratio(0.32), (1.0 / 0.3) / (1.0 / 0.1), 0.06);
  EXPECT_LT(evidence.ratio(0.27), 0.02);
  EXPECT_GT(evidence.ratio(0.5), 50.0);
}

TEST(ConfidenceEvidence, ItFollowsWhatChanges) {
  ConfidenceEvidence evidence;
  const auto fly = [&](double object, double nothing) {
    for (int i = 0; i < 20000; ++i) {
      evidence.count_object(object);
      evidence.count_false(counts_of({nothing}));
    }
  };
  fly(0.9, 0.3);
  EXPECT_GT(evidence.ratio(0.9), 10.0);
  fly(0.3, 0.9);
  EXPECT_LT(evidence.ratio(0.9), 0.1);
}

}  // namespace
}  // namespace geoloc
