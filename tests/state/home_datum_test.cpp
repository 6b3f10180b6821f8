// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/home_datum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/time.hpp"

namespace geoloc {
namespace {

VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}

/// A vehicle whose climbs and descents are known, and whose two heights may each go wrong.
struct Flight {
  double rate_hz = 10.0;
  double home_msl_m = 485.0;

  static double height_m(double time_s) { return 20.0 + 3.0 * std::sin(0.5 * time_s); }
  double time_s(int sample) const { return 100.0 + sample / rate_hz; }
};

TEST(HomeDatum, KeepsHeightsAboveTheFirstHomeWhateverIsCalledHomeLater) {
  for (const double rate_hz : {1.0, 2.0, 10.0, 50.0}) {
    for (const double moved_m : {-30.0, -3.0, 1.0, 20.0}) {
      const Flight flight{rate_hz};
      HomeDatum datum;
      for (int i = 0; i < 200; ++i) {
        const double height_m = flight.height_m(flight.time_s(i));
        const double home_m = i < 80 ? 0.0 : i < 140 ? moved_m : 0.5 * moved_m;
        EXPECT_NEAR(
            datum.above_first_home_m(at_s(flight.time_s(i)), height_m - home_m, flight.home_msl_m + height_m),
            height_m, 1e-9)
            << rate_hz << " Hz, " << moved_m << " m, sample " << i;
      }
      EXPECT_NEAR(datum.moved_up_m(), 0.5 * moved_m, 1e-9);
      EXPECT_EQ(datum.moves(), 2U);
    }
  }
}

TEST(HomeDatum, HoldsAcrossAnOutageOfTheLink) {
  const Flight flight;
  HomeDatum datum;
  for (int i = 0; i < 100; ++i) datum.above_first_home_m(at_s(flight.time_s(i)), 20.0, 505.0);
  // Home was set 3 m lower, and the vehicle has gone down to be as high above it as before.
  EXPECT_NEAR(datum.above_first_home_m(at_s(130.0), 20.0, 502.0), 17.0, 1e-9);
}

TEST(HomeDatum, ConcludesNothingFromAStepOfTheHeightAboveSeaLevel) {
  const Flight flight;
  HomeDatum datum;
  for (int i = 0; i < 200; ++i) {
    const double height_m = flight.height_m(flight.time_s(i));
    const double msl_error_m = i < 100 ? 0.0 : 8.0;
    EXPECT_EQ(datum.above_first_home_m(at_s(flight.time_s(i)), height_m, 500.0 + height_m + msl_error_m),
              height_m);
  }
  EXPECT_EQ(datum.moves(), 0U);
}

TEST(HomeDatum, ConcludesNothingFromAStepOfBothHeights) {
  HomeDatum datum;
  for (int i = 0; i < 200; ++i) {
    const double height_m = i < 100 ? 20.0 : 30.0;
    EXPECT_EQ(datum.above_first_home_m(at_s(0.1 * i), height_m, 500.0 + height_m), height_m);
  }
}

/// Some vehicles take the height above sea level from the receiver, and the other one from the barometer.
TEST(HomeDatum, IsNotMisledByHeightsFromDifferentSensors) {
  const Flight flight;
  HomeDatum datum;
  for (int i = 0; i < 2000; ++i) {
    const double height_m = flight.height_m(flight.time_s(i));
    const double wander_m = 2.0 * std::sin(37.0 * i * i) + 4.0 * std::sin(0.01 * i);
    datum.above_first_home_m(at_s(flight.time_s(i)), height_m, 500.0 + height_m + wander_m);
  }
  EXPECT_EQ(datum.moves(), 0U);
}

TEST(HomeDatum, TakesTheHomeSetAtTakeOffForTheFirst) {
  HomeDatum datum;
  for (int i = 0; i < 50; ++i) datum.above_first_home_m(at_s(0.1 * i), -1.4, 498.6);
  EXPECT_EQ(datum.above_first_home_m(at_s(5.0), 0.0, 498.6), 0.0);
  EXPECT_EQ(datum.above_first_home_m(at_s(5.1), 0.0, 498.6), 0.0);
  EXPECT_EQ(datum.moves(), 0U);
}

TEST(HomeDatum, GivesLateSamplesTheHomeOfTheirTime) {
  HomeDatum datum;
  for (int i = 0; i < 50; ++i) datum.above_first_home_m(at_s(0.1 * i), 20.0, 520.0);
  for (int i = 50; i < 60; ++i) datum.above_first_home_m(at_s(0.1 * i), 23.0, 520.0);
  EXPECT_NEAR(datum.above_first_home_m(at_s(4.85), 20.0, 520.0), 20.0, 1e-9);
  EXPECT_NEAR(datum.above_first_home_m(at_s(5.55), 23.0, 520.0), 20.0, 1e-9);
}

TEST(HomeDatum, PassesHeightsOnWhereThereIsNoOther) {
  HomeDatum datum;
  EXPECT_EQ(datum.above_first_home_m(at_s(0.0), 20.0, std::nullopt), 20.0);
  EXPECT_EQ(datum.above_first_home_m(at_s(0.1), 23.0, std::nan("")), 23.0);
  EXPECT_EQ(datum.moves(), 0U);
}

}  // namespace
}  // namespace geoloc
