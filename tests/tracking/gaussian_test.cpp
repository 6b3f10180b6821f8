// SPDX-License-Identifier: Apache-2.0
#include "tracking/gaussian.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

Eigen::Matrix2d symmetric(double xx, double xy, double yy) {
  return (Eigen::Matrix2d() << xx, xy, xy, yy).finished();
}

TEST(KalmanUpdate, IsTheInformationWeightedMean) {
  const Gaussian2 prior{{1, 2}, symmetric(2, 0.5, 1)};
  const Eigen::Vector2d measurement{2, 0};
  const Eigen::Matrix2d r = symmetric(0.5, -0.1, 0.3);
  const Gaussian2 posterior = kalman_update(prior, measurement, r);
  const Eigen::Matrix2d information = prior.covariance.inverse() + r.inverse();
  EXPECT_TRUE(posterior.covariance.isApprox(information.inverse(), 1e-12));
  const Eigen::Vector2d mean =
      information.inverse() * (prior.covariance.inverse() * prior.mean + r.inverse() * measurement);
  EXPECT_TRUE(posterior.mean.isApprox(mean, 1e-12));
}

TEST(KalmanUpdate, OfManyEqualMeasurementsConvergesOnTheirMean) {
  Gaussian2 track{{0, 0}, symmetric(1, 0, 1)};
  for (int i = 0; i < 1000; ++i)
    track = kalman_update(track, {i % 2 == 0 ? 1.0 : 3.0, 5.0}, symmetric(1, 0, 1));
  EXPECT_NEAR(track.mean.x(), 2.0, 0.01);
  EXPECT_NEAR(track.covariance(0, 0), 1.0 / 1001.0, 1e-9);
  EXPECT_EQ(track.covariance(0, 1), track.covariance(1, 0));
}

TEST(Mahalanobis, IsTheDistanceInSigmas) {
  EXPECT_DOUBLE_EQ(mahalanobis_squared({3, 0}, symmetric(9, 0, 1)), 1.0);
  EXPECT_DOUBLE_EQ(mahalanobis_squared({0, 3}, symmetric(9, 0, 1)), 9.0);
}

TEST(Density, IsTheProductOfItsAxesDensitiesAndIntegratesToOne) {
  const auto along_axis = [](double x, double variance) {
    return std::exp(-0.5 * x * x / variance) / std::sqrt(2.0 * kPi * variance);
  };
  EXPECT_DOUBLE_EQ(density({1.5, -0.5}, symmetric(4, 0, 0.25)), along_axis(1.5, 4) * along_axis(-0.5, 0.25));
  const double step = 0.05;
  double sum = 0.0;
  for (int i = -300; i < 300; ++i) {
    for (int j = -300; j < 300; ++j) sum += step * step * density({step * i, step * j}, symmetric(4, 1.2, 1));
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

}  // namespace
}  // namespace geoloc
