// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/turn_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr double kPause_s = 0.1;

/// A vehicle that rolls to and fro, told ten times a second.
class Rolling {
 public:
  /// `per_true_rate`: what is told of a rate, by what it is.
  Rolling(double noise_deg, double per_true_rate) : noise_deg_(noise_deg), per_true_rate_(per_true_rate) {}

  static double roll_rad(double time_s) { return 0.1 * std::sin(1.5 * time_s); }
  static double rate_radps(double time_s) { return 0.15 * std::cos(1.5 * time_s); }

  AttitudeSample at(double time_s) {
    AttitudeSample sample;
    sample.time = VehicleTime{from_seconds(time_s)};
    sample.angles = {roll_rad(time_s) + noise_rad(), noise_rad(), noise_rad()};
    sample.rates_in_body_radps = Eigen::Vector3d(per_true_rate_ * rate_radps(time_s), 0.0, 0.0);
    return sample;
  }

  void tell(double seconds, TurnRates& rates) {
    for (double time_s = 0.0; time_s < seconds; time_s += kPause_s) rates.observe(at(time_s));
  }

 private:
  double noise_rad() { return noise_deg_ * kRadPerDeg * normal_(random_); }

  double noise_deg_, per_true_rate_;
  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
};

/// RMS error of the rate of roll half-way between samples, from the hundredth second on.
double rms_error_radps(Rolling vehicle, const TurnRates& rates) {
  double squares = 0.0;
  constexpr int kCount = 200;
  for (int i = 0; i < kCount; ++i) {
    const double time_s = 100.0 + kPause_s * i;
    const double told = rates.between(vehicle.at(time_s), vehicle.at(time_s + kPause_s), 0.5).x();
    squares += std::pow(told - Rolling::rate_radps(time_s + 0.5 * kPause_s), 2);
  }
  return std::sqrt(squares / kCount);
}

TEST(TurnRates, AreTheDifferenceOfAttitudesWhereNoneAreTold) {
  TurnRates rates;
  AttitudeSample before, after;
  before.time = VehicleTime{from_seconds(3.0)};
  after.time = VehicleTime{from_seconds(3.2)};
  after.angles.pitch_rad = 0.1;
  for (const AttitudeSample& sample : {before, after}) rates.observe(sample);
  EXPECT_FALSE(rates.are_believed());
  EXPECT_LT((rates.between(before, after, 0.7) - Eigen::Vector3d(0.0, 0.5, 0.0)).norm(), 1e-12);
}

TEST(TurnRates, AreThoseThatAreToldOnceTheyHaveProvedRight) {
  TurnRates rates;
  Rolling vehicle(0.0, 1.0);
  EXPECT_FALSE(rates.are_believed());
  vehicle.tell(1.0, rates);
  EXPECT_TRUE(rates.are_believed());
  EXPECT_LT(rms_error_radps(vehicle, rates), 1e-3);
}

/// The difference of two attitudes is off by 21 degrees a second here.
TEST(TurnRates, AreNotHurtByTheNoiseOfAttitudes) {
  TurnRates rates;
  Rolling vehicle(1.5, 1.0);
  EXPECT_GT(rms_error_radps(vehicle, rates), 0.3);
  vehicle.tell(60.0, rates);
  EXPECT_TRUE(rates.are_believed());
  EXPECT_LT(rms_error_radps(vehicle, rates), 1e-3);
}

TEST(TurnRates, ThatAreWrongAreNotBelieved) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double per_true_rate : {0.0, -1.0, 1.0 / kRadPerDeg, kRadPerDeg, kNaN}) {
    for (const double noise_deg : {0.0, 0.1, 1.5}) {
      TurnRates rates;
      Rolling vehicle(noise_deg, per_true_rate);
      vehicle.tell(200.0, rates);
      EXPECT_FALSE(rates.are_believed()) << per_true_rate << ", " << noise_deg;
    }
  }
}

TEST(TurnRates, ThatAreNoiseAreNotBelieved) {
  TurnRates rates;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Rolling vehicle(0.0, 1.0);
  for (double time_s = 0.0; time_s < 100.0; time_s += kPause_s) {
    AttitudeSample sample = vehicle.at(time_s);
    for (double& rate : *sample.rates_in_body_radps) rate += 0.5 * normal(random);
    rates.observe(sample);
  }
  EXPECT_FALSE(rates.are_believed());
}

/// Across a reboot, or a pause, a turn says nothing of the rates.
TEST(TurnRates, LearnNothingFromWhatDoesNotFollow) {
  TurnRates rates;
  Rolling vehicle(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    rates.observe(vehicle.at(0.1 * i));
    rates.restart();
  }
  for (int i = 0; i < 20; ++i) rates.observe(vehicle.at(10.0 + 1.5 * i));
  EXPECT_FALSE(rates.are_believed());
}

}  // namespace
}  // namespace geoloc
