// SPDX-License-Identifier: Apache-2.0
#include "tracking/constant_velocity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace geoloc {
namespace {

TEST(ConstantVelocity, StatesTheErrorItMakes) {
  constexpr double kSigmaAcceleration = 0.8, kSigma_m = 0.3, kSigmaSpeed_mps = 4.0, kPeriod_s = 0.2;
  constexpr int kRuns = 400, kSteps = 40;
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::Vector2d position(normal(random), normal(random));
    Eigen::Vector2d velocity = kSigmaSpeed_mps * Eigen::Vector2d(normal(random), normal(random));
    const auto measured = [&] {
      return Eigen::Vector2d(position + kSigma_m * Eigen::Vector2d(normal(random), normal(random)));
    };
    const Eigen::Matrix2d noise = kSigma_m * kSigma_m * Eigen::Matrix2d::Identity();
    ConstantVelocity estimate = ConstantVelocity::at(measured(), noise, kSigmaSpeed_mps);
    for (int step = 0; step < kSteps; ++step) {
      // The true object moves in steps a hundred times finer: white noise of the acceleration.
      for (int fine = 0; fine < 100; ++fine) {
        const double dt = kPeriod_s / 100;
        position += dt * velocity;
        velocity += kSigmaAcceleration * std::sqrt(dt) * Eigen::Vector2d(normal(random), normal(random));
      }
      estimate.predict(kPeriod_s, kSigmaAcceleration);
      estimate.update(measured(), noise);
    }
    Eigen::Vector4d error;
    error << estimate.position() - position, estimate.velocity() - velocity;
    nees += error.dot(estimate.covariance.llt().solve(error));
  }
  EXPECT_NEAR(nees / kRuns, 4.0, 4.0 * std::sqrt(2.0 * 4.0 / kRuns));  // mean of chi-square, four sigmas
}

TEST(ConstantVelocity, PredictionInTwoStepsIsThatInOne) {
  ConstantVelocity one = ConstantVelocity::at({1, 2}, Eigen::Matrix2d::Identity(), 3.0);
  one.mean.tail<2>() << 0.5, -2.0;
  ConstantVelocity two = one;
  one.predict(1.5, 0.7);
  two.predict(0.6, 0.7);
  two.predict(0.9, 0.7);
  EXPECT_LT((one.mean - two.mean).norm(), 1e-12);
  EXPECT_LT((one.covariance - two.covariance).norm(), 1e-12);
}

}  // namespace
}  // namespace geoloc
