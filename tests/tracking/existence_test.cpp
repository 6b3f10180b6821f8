// SPDX-License-Identifier: Apache-2.0
#include "tracking/existence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace geoloc {
namespace {

/// Bayes' rule for two hypotheses, with probabilities instead of log-odds.
double posterior(double prior, double given_object, double given_none) {
  return prior * given_object / (prior * given_object + (1.0 - prior) * given_none);
}

TEST(Existence, BeginsAtItsBirthProbability) {
  for (const double probability : {0.001, 0.3, 0.5, 0.97})
    EXPECT_NEAR(Existence(probability).probability(), probability, 1e-12);
}

TEST(Existence, OfASequenceOfLooksIsThatOfBayesRule) {
  constexpr double kDetection = 0.8, kClutter = 0.02;
  Existence existence(0.3);
  double expected = 0.3;
  for (const double likelihood : {0.05, 0.0, 0.3, 0.0, 0.0, 0.004, 1.5}) {  // 0: a miss
    if (likelihood > 0.0) {
      existence.hit(kDetection, likelihood, kClutter);
      expected = posterior(expected, kDetection * likelihood, kClutter);
    } else {
      existence.miss(kDetection);
      expected = posterior(expected, 1.0 - kDetection, 1.0);
    }
    EXPECT_NEAR(existence.probability(), expected, 1e-12);
  }
}

TEST(Existence, ALookThatIsLessLikelyThanClutterSpeaksAgainstIt) {
  Existence existence(0.5);
  existence.hit(0.9, 0.001, 0.01);
  EXPECT_NEAR(existence.probability(), posterior(0.5, 0.9 * 0.001, 0.01), 1e-12);
  EXPECT_LT(existence.probability(), 0.1);
}

TEST(Existence, OtherEvidenceCountsByItsLikelihoodRatio) {
  for (const double ratio : {0.05, 0.5, 3.0}) {
    Existence existence(0.3);
    existence.weigh(ratio);
    EXPECT_NEAR(existence.probability(), posterior(0.3, ratio, 1.0), 1e-12);
  }
  Existence existence(0.3);
  existence.weigh(1.0);
  EXPECT_EQ(existence.probability(), Existence(0.3).probability());
}

TEST(Existence, OneLookMultipliesTheOddsByNoMoreThanSixPowersOfE) {
  const double most = std::exp(6.0);
  Existence sure(0.5), gone(0.5);
  sure.hit(0.9, 1e9, 1e-9);
  gone.miss(1.0 - 1e-12);
  EXPECT_NEAR(sure.probability(), most / (1.0 + most), 1e-12);
  EXPECT_NEAR(gone.probability(), 1.0 / (1.0 + most), 1e-12);
}

TEST(Existence, ABeliefOfAThousandLooksIsUndoneByAFew) {
  const double most = std::exp(16.0);
  Existence existence(0.5);
  for (int i = 0; i < 1000; ++i) existence.hit(0.9, 1.0, 1e-3);
  EXPECT_NEAR(1.0 - existence.probability(), 1.0 / (1.0 + most), 1e-13);
  for (int i = 0; i < 3; ++i) existence.miss(1.0 - 1e-12);
  EXPECT_NEAR(existence.probability(), std::exp(16.0 - 18.0) / (1.0 + std::exp(16.0 - 18.0)), 1e-12);
  for (int i = 0; i < 1000; ++i) existence.miss(0.9);
  EXPECT_NEAR(existence.probability(), 1.0 / (1.0 + most), 1e-13);
}

TEST(Existence, OfTwoTracksOfOneObjectIsThatOfTheSurerOne) {
  for (const auto& [one, other] : std::vector<std::pair<double, double>>{{0.2, 0.9}, {0.9, 0.2}}) {
    Existence kept(one);
    kept.merge(Existence(other));
    EXPECT_NEAR(kept.probability(), 0.9, 1e-12);
  }
}

}  // namespace
}  // namespace geoloc
