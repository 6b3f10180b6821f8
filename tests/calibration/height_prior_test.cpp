// SPDX-License-Identifier: Apache-2.0
#include "calibration/height_prior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

constexpr HeightPrior kPrior{1.0, 2.0};

/// Minus the logarithm of Student's density with one degree of freedom, but for a constant.
double cost(const HeightPrior& prior, double height_m) {
  const double z = (height_m - prior.mean_m) / prior.sigma_m;
  return std::log(1.0 + z * z);
}

/// Iteratively reweighted least squares: the Gaussian that stands for the density at a height pulls from
/// there as the density does, by finite differences.
TEST(HeightPrior, PullsAsTheHeavyTailedDensityDoes) {
  constexpr double kStep_m = 1e-5;
  for (const double height_m : {-60.0, -4.0, 0.0, 0.9, 1.1, 3.0, 21.0}) {
    const double pull =
        (cost(kPrior, height_m + kStep_m) - cost(kPrior, height_m - kStep_m)) / (2.0 * kStep_m);
    const double sigma_m = kPrior.sigma_at(height_m);
    EXPECT_NEAR((height_m - kPrior.mean_m) / (sigma_m * sigma_m), pull, 1e-8) << height_m;
  }
}

TEST(HeightPrior, IsAsSharpAsTheDensityInTheMiddle) {
  constexpr double kStep_m = 1e-3;
  const double curvature =
      (cost(kPrior, kPrior.mean_m + kStep_m) + cost(kPrior, kPrior.mean_m - kStep_m)) / (kStep_m * kStep_m);
  EXPECT_NEAR(1.0 / std::pow(kPrior.sigma_at(kPrior.mean_m), 2), curvature, 1e-6);
}

/// Weighted means of prior and measurement, each with the weights of the one before, end where the sum of the
/// costs is least: by search.
TEST(HeightPrior, LeadsToTheMostProbableHeight) {
  constexpr double kNoise_m = 1.5;
  for (const double measured_m : {1.5, 4.0, 30.0, -25.0}) {
    double best_m = 0.0, least = 1e9;
    for (double height_m = -40.0; height_m < 40.0; height_m += 1e-3) {
      const double sum = cost(kPrior, height_m) + 0.5 * std::pow((height_m - measured_m) / kNoise_m, 2);
      if (sum < least) best_m = height_m;
      least = std::min(least, sum);
    }
    double height_m = kPrior.mean_m;
    for (int round = 0; round < 200; ++round) {
      const double information = std::pow(kPrior.sigma_at(height_m), -2);
      const double of_measurement = std::pow(kNoise_m, -2);
      height_m = (information * kPrior.mean_m + of_measurement * measured_m) / (information + of_measurement);
    }
    EXPECT_NEAR(height_m, best_m, 2e-3) << measured_m;
  }
}

TEST(HeightPrior, OfAHeightThatIsKnownIsThatEverywhere) {
  const HeightPrior known{3.0, 0.0};
  EXPECT_EQ(known.sigma_at(3.0), 0.0);
  EXPECT_EQ(known.sigma_at(50.0), 0.0);
}

// --- What the first frame adds.

TEST(HeightPrior, StandsWhereTheVehicleReportsToBeAboveTheUsualHeight) {
  for (const double reported_m : {9.0, 9.001, 30.0, 500.0}) {  // ten and more with the mean
    EXPECT_EQ(seen_from(reported_m, kPrior).mean_m, kPrior.mean_m);
    EXPECT_EQ(seen_from(reported_m, kPrior).sigma_m, kPrior.sigma_m);
  }
}

TEST(HeightPrior, LiftsAVehicleThatReportsToBeLowToTheUsualHeight) {
  for (const double reported_m : {-40.0, -1.0, 0.0, 4.0, 8.9}) {
    const HeightPrior lifted = seen_from(reported_m, kPrior);
    EXPECT_NEAR(reported_m + lifted.mean_m, 10.0, 1e-12);
    // It may well be that nothing is missing.
    EXPECT_NEAR(lifted.sigma_m, std::max(2.0, lifted.mean_m - kPrior.mean_m), 1e-12);
  }
}

TEST(HeightPrior, ThatIsKnownStandsWhateverTheVehicleReports) {
  const HeightPrior known = seen_from(-30.0, {3.0, 0.0});
  EXPECT_EQ(known.mean_m, 3.0);
  EXPECT_EQ(known.sigma_m, 0.0);
}

}  // namespace
}  // namespace geoloc
