// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/step_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geoloc/geometry/time.hpp"

namespace geoloc {
namespace {

VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}

constexpr StepLimits kLimits{1.0, 7.0, 7.0, 0.3, 0.005};
using Detector = StepDetector<2>;

/// Eastwards and northwards in turns of ten seconds, at 5 m/s, with bends at once.
Eigen::Vector2d sharp_lanes(double time_s) {
  const double into_s = std::fmod(time_s, 20.0);
  const double lane = 50.0 * std::floor(time_s / 20.0);
  return into_s < 10.0 ? Eigen::Vector2d(lane + 5.0 * into_s, lane)
                       : Eigen::Vector2d(lane + 50.0, lane + 5.0 * (into_s - 10.0));
}

/// The same with bends that take a second: accelerations of 7 m/s^2.
Eigen::Vector2d lanes(double time_s) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  constexpr int kParts = 100;
  for (int i = 0; i < kParts; ++i) mean += sharp_lanes(time_s + (i + 0.5) / kParts) / kParts;
  return mean;
}

/// As hard as the limits allow, to and fro.
Eigen::Vector2d wild(double time_s) {
  constexpr double kAcceleration = 7.0, kRate = 1.3;
  return Eigen::Vector2d(std::sin(kRate * time_s), 0.0) * kAcceleration / (kRate * kRate);
}

TEST(StepDetector, TakesNoMotionThatAVehicleCanMakeForAStep) {
  for (const auto& path : {lanes, wild}) {
    for (const double rate_hz : {0.5, 1.0, 2.0, 5.0, 10.0, 50.0}) {
      Detector detector(kLimits);
      for (int i = 0; i < 2000; ++i) detector.observe(at_s(i / rate_hz), path(i / rate_hz));
      EXPECT_EQ(detector.steps().count, 0U) << rate_hz << " Hz";
    }
  }
}

/// Frames at such a bend are lost, and nothing else.
TEST(StepDetector, TakesBackAStepThatProvesToBeAHarderManoeuvreThanVehiclesMake) {
  for (const double rate_hz : {2.0, 5.0}) {
    Detector detector(kLimits);
    for (int i = 0; i / rate_hz < 200.0; ++i) detector.observe(at_s(i / rate_hz), sharp_lanes(i / rate_hz));
    EXPECT_GT(detector.steps().count, 0U);
    EXPECT_LT(detector.steps().size.norm(), 1e-9) << rate_hz << " Hz";
  }
}

TEST(StepDetector, TakesNoNoiseForAStepOnceItKnowsIt) {
  std::mt19937 random(1);
  std::normal_distribution<double> metres(0.0, 0.5);
  Detector detector(kLimits);
  std::uint32_t at_first = 0;
  for (int i = 0; i < 5000; ++i) {
    detector.observe(at_s(0.1 * i), lanes(0.1 * i) + Eigen::Vector2d(metres(random), metres(random)));
    if (i == 50) at_first = detector.steps().count;
  }
  EXPECT_LE(at_first, 2U);
  EXPECT_LE(detector.steps().count, at_first + 2U);
}

TEST(StepDetector, TakesNoPauseOfTheTelemetryForAStep) {
  Detector detector(kLimits);
  for (int i = 0; i < 3000; ++i) {
    const double time_s = 0.1 * i;
    if (std::fmod(time_s, 25.0) < 6.0) continue;  // the vehicle turns meanwhile, at times
    detector.observe(at_s(time_s), lanes(time_s));
  }
  EXPECT_EQ(detector.steps().count, 0U);
}

/// Rate of change of a path, by differences.
template <typename Path>
Eigen::Vector2d rate_of(const Path& path, double time_s) {
  constexpr double kHalf_s = 1e-4;
  return (path(time_s + kHalf_s) - path(time_s - kHalf_s)) / (2.0 * kHalf_s);
}

/// Bends within a tenth of a second, at 80 m/s: 800 m/s^2, a hundred times what the limits allow.
Eigen::Vector2d rushing_lanes(double time_s) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  constexpr int kParts = 100;
  for (int i = 0; i < kParts; ++i) mean += 16.0 * sharp_lanes(time_s + 0.1 * (i + 0.5) / kParts) / kParts;
  return mean;
}

TEST(StepDetector, TakesNoMotionForAStepThatItsOwnRatesTell) {
  Detector without(kLimits), with(kLimits);
  for (int i = 0; i < 2000; ++i) {
    const double time_s = 0.1 * i;
    without.observe(at_s(time_s), rushing_lanes(time_s));
    with.observe(at_s(time_s), rushing_lanes(time_s), rate_of(rushing_lanes, time_s));
  }
  EXPECT_GT(without.steps().count, 0U);
  EXPECT_EQ(with.steps().count, 0U);
}

/// 7 m/s^2 make 1.75 m of half a second after half a second. Rates tell that they were not made.
TEST(StepDetector, SeesBetweenSlowSamplesWhatTheirRatesDoNotTell) {
  const Eigen::Vector2d step(1.5, -2.0);
  for (const double begin_s : {25.2, 33.4, 37.0}) {
    Detector without(kLimits), with(kLimits);
    for (int i = 0; i < 120; ++i) {
      const double time_s = 0.5 * i;
      const Eigen::Vector2d value = lanes(time_s) + (time_s >= begin_s ? step : step * 0.0);
      without.observe(at_s(time_s), value);
      with.observe(at_s(time_s), value, rate_of(lanes, time_s));
    }
    EXPECT_EQ(without.steps().count, 0U);
    EXPECT_EQ(with.steps().count, 1U) << begin_s;
    EXPECT_LT((with.steps().size - step).norm(), 3.0 * std::sqrt(with.steps().variance[0])) << begin_s;
  }
}

/// As some senders do.
TEST(StepDetector, DoesNotBelieveRatesThatAreLeftZero) {
  for (const double rate_hz : {0.5, 1.0, 2.0, 5.0, 10.0, 50.0}) {
    Detector detector(kLimits);
    for (int i = 0; i < 2000; ++i)
      detector.observe(at_s(i / rate_hz), lanes(i / rate_hz), Eigen::Vector2d(0.0, 0.0));
    EXPECT_EQ(detector.steps().count, 0U) << rate_hz << " Hz";
  }
  Detector detector(kLimits);
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector2d step(i >= 370 ? 2.0 : 0.0, 0.0);
    detector.observe(at_s(0.1 * i), lanes(0.1 * i) + step, Eigen::Vector2d(0.0, 0.0));
  }
  EXPECT_EQ(detector.steps().count, 1U);
}

/// The rates of a vehicle that accelerates as hard as the limits allow, to and fro.
TEST(StepDetector, TakesNoMotionForAStepBesideTrueRates) {
  for (const auto& path : {lanes, wild}) {
    for (const double rate_hz : {0.5, 1.0, 2.0, 5.0, 10.0, 50.0}) {
      Detector detector(kLimits);
      for (int i = 0; i < 2000; ++i)
        detector.observe(at_s(i / rate_hz), path(i / rate_hz), rate_of(path, i / rate_hz));
      EXPECT_EQ(detector.steps().count, 0U) << rate_hz << " Hz";
    }
  }
}

struct Step {
  double rate_hz;
  double metres;
};

class Steps : public ::testing::TestWithParam<Step> {};

TEST_P(Steps, AreMeasuredWhereverTheyHappenAndWhereTheyGoBack) {
  const auto [rate_hz, metres] = GetParam();
  const Eigen::Vector2d step = metres * Eigen::Vector2d(0.6, -0.8);
  for (const double begin_s : {15.0, 19.7, 20.1, 37.0}) {
    const double end_s = begin_s + 5.0;
    Detector detector(kLimits);
    for (int i = 0; i / rate_hz < 60.0; ++i) {
      const double time_s = i / rate_hz;
      const bool is_off = time_s >= begin_s && time_s < end_s;
      const StepSum<2>& steps = detector.observe(at_s(time_s), lanes(time_s) + (is_off ? step : step * 0.0));
      const double sigma = std::sqrt(steps.variance[0]);
      EXPECT_LT((steps.size - (is_off ? step : step * 0.0)).norm(), 3.0 * sigma + 1e-6)
          << begin_s << " s, at " << time_s;
    }
    EXPECT_EQ(detector.steps().count, 2U) << begin_s;
  }
}

INSTANTIATE_TEST_SUITE_P(FromSampleToSample, Steps,
                         ::testing::Values(Step{50.0, 2.0}, Step{10.0, 2.0}, Step{10.0, 50.0}, Step{5.0, 3.0},
                                           Step{2.0, 50.0}, Step{1.0, 50.0}));

TEST(StepDetector, CountsThereAndBackOfASingleWrongSample) {
  Detector detector(kLimits);
  for (int i = 0; i < 100; ++i)
    detector.observe(at_s(0.1 * i), lanes(0.1 * i) + Eigen::Vector2d(0.0, i == 60 ? 30.0 : 0.0));
  EXPECT_EQ(detector.steps().count, 2U);
  EXPECT_LT(detector.steps().size.norm(), 0.1);
}

TEST(StepDetector, HoldsAMovementWithoutEndForMotionAndSaysThatItIsUnsure) {
  Detector detector(kLimits);
  const auto rushing = [](double time_s) {
    return Eigen::Vector2d(time_s < 5.0 ? 0.0 : 80.0 * (time_s - 5.0), 0.0);
  };
  for (int i = 0; i < 200; ++i) detector.observe(at_s(0.1 * i), rushing(0.1 * i));
  EXPECT_LT(detector.steps().count, 12U);
  EXPECT_GT(std::sqrt(detector.steps().variance[0]), 40.0);
}

TEST(StepDetector, ForgetsTheMotionButNotTheSteps) {
  Detector detector(kLimits);
  for (int i = 0; i < 20; ++i) detector.observe(at_s(0.1 * i), {i < 10 ? 0.0 : 9.0, 0.0});
  detector.restart();
  for (int i = 0; i < 20; ++i) detector.observe(at_s(0.1 * i), {400.0, 0.0});
  EXPECT_EQ(detector.steps().count, 1U);
  EXPECT_NEAR(detector.steps().size[0], 9.0, 1e-9);
}

}  // namespace
}  // namespace geoloc
