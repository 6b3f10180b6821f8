// SPDX-License-Identifier: Apache-2.0
// What a log that rounds its coordinates still tells of where the vehicle was.
#include "import/rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace geoloc::apps {
namespace {

constexpr double kStep_m = 0.111;  // a millionth of a degree of latitude

/// Ten times a second.
struct Way {
  std::vector<double> time_s, true_m, rounded_m;
};

/// To and fro at about 5 m/s, with turns that take a second; between them the vehicle sways by centimetres.
Way to_and_fro() {
  Way way;
  double place_m = 0.0, speed_mps = 5.0, wanted_mps = 5.0;
  for (int i = 0; i < 900; ++i) {
    const double time_s = 0.1 * i;
    if (i % 150 == 149) wanted_mps = -wanted_mps;
    speed_mps += 0.3 * (wanted_mps - speed_mps);
    place_m += 0.1 * (speed_mps + 0.1 * std::sin(0.9 * time_s));
    way.time_s.push_back(time_s);
    way.true_m.push_back(place_m);
    way.rounded_m.push_back(std::round(place_m / kStep_m) * kStep_m);
  }
  return way;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// What each changes by in a second, from one to the next.
std::vector<double> rates(const std::vector<double>& values) {
  std::vector<double> rates;
  for (std::size_t i = 1; i < values.size(); ++i) rates.push_back((values[i] - values[i - 1]) / 0.1);
  return rates;
}

TEST(Rounding, IsTakenOutWhereAVehicleFliesOn) {
  const Way way = to_and_fro();
  const std::vector<double> found_m = unrounded(way.time_s, way.rounded_m, kStep_m);
  EXPECT_LT(rms(found_m, way.true_m), 0.6 * rms(way.rounded_m, way.true_m));
  EXPECT_LT(rms(rates(found_m), rates(way.true_m)), 0.4 * rms(rates(way.rounded_m), rates(way.true_m)));
}

TEST(Rounding, LeavesEachValueWithinHalfAStep) {
  Way way = to_and_fro();
  for (std::size_t i = 400; i < way.rounded_m.size(); ++i) way.rounded_m[i] += 500.0 * kStep_m;  // a glitch
  way.time_s[600] = way.time_s[599];
  const std::vector<double> found_m = unrounded(way.time_s, way.rounded_m, kStep_m);
  for (std::size_t i = 0; i < found_m.size(); ++i)
    EXPECT_LE(std::abs(found_m[i] - way.rounded_m[i]), 0.5001 * kStep_m);  // false for NaN
}

TEST(Rounding, OfWhatStandsIsTheMiddle) {
  const std::vector<double> time_s{0.0, 0.5, 1.0, 1.5, 2.0}, told(5, 3.0);
  for (const double value : unrounded(time_s, told, 1.0)) EXPECT_NEAR(value, 3.0, 1e-3);
}

TEST(Rounding, OfTwoValuesTellsNothing) {
  EXPECT_EQ(unrounded({0.0, 1.0}, {1.0, 2.0}, 1.0), (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(unrounded({}, {}, 1.0).empty());
}

TEST(Rounding, IsFoundInTheNumbers) {
  EXPECT_DOUBLE_EQ(rounding_step({53.365080, 53.365081, -12.5}, 1e-6), 1e-6);
  EXPECT_DOUBLE_EQ(rounding_step({149.0251, 149.0253}, 1e-6), 1e-4);
  EXPECT_DOUBLE_EQ(rounding_step({5.4, 5.0}, 0.1), 0.1);
  EXPECT_EQ(rounding_step({53.3650804, 53.365081}, 1e-6), 0.0);
  EXPECT_EQ(rounding_step({5.41, 5.0}, 0.1), 0.0);
}

}  // namespace
}  // namespace geoloc::apps
