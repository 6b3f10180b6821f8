// SPDX-License-Identifier: Apache-2.0
#include "fleet/association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fleet/shift_search.hpp"
#include "fleet/synthetic_fleet.hpp"

namespace geoloc {
namespace {

using testing::clustered_targets;
using testing::draw_flight;
using testing::FlightErrors;

/// All flights saw the same targets in the same order, so that objects are one where their places are.
bool is_right(const std::vector<Members>& objects, std::size_t targets) {
  return objects.size() == targets && std::all_of(objects.begin(), objects.end(), [](const Members& members) {
           return std::all_of(members.begin(), members.end(), [&](const Contribution& member) {
             return member.object == members.front().object;
           });
         });
}

AssociatedFlight flight_to_associate(std::size_t number, const FlightModel& model,
                                     const std::vector<int>& classes) {
  return {number, model, flight_of(number, model).parts.front(), classes};
}

std::vector<Members> associate_all(const std::vector<FlightModel>& models, std::size_t targets) {
  std::vector<AssociatedFlight> flights;
  for (const FlightModel& model : models)
    flights.push_back(flight_to_associate(flights.size(), model, std::vector<int>(targets, 0)));
  return associate(flights, {});
}

/// However far the flights are off in common, up to what is searched.
TEST(Association, TheShiftOfAFlightIsFound) {
  for (const double shift_m : {0.0, 2.0, 5.0, 12.0}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      std::mt19937 random(seed);
      const auto targets = clustered_targets(30, random);
      std::vector<FlightModel> models;
      for (int i = 0; i < 3; ++i) {
        FlightSummary summary = draw_flight("a", targets, {}, random);
        if (i == 1) testing::move_east(shift_m, summary);
        models.push_back(model_of(summary, 4, 3.0));
      }
      EXPECT_TRUE(is_right(associate_all(models, 30), 30)) << shift_m << " m, seed " << seed;
    }
  }
}

/// Far from the middle a yaw of a degree moves objects by more than their distance.
TEST(Association, AFlightIsTurnedWhereItsYawIsOff) {
  FlightErrors errors;
  errors.yaw_rad = 0.02;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const auto targets = clustered_targets(30, random);
    std::vector<FlightModel> models;
    for (int i = 0; i < 3; ++i) models.push_back(model_of(draw_flight("a", targets, errors, random), 4, 3.0));
    EXPECT_TRUE(is_right(associate_all(models, 30), 30)) << seed;
  }
}

/// Two objects among others that are not there: a shift that brings them together by chance is no evidence.
TEST(Association, AFewObjectsThatFitByChanceAreNotTheSame) {
  std::mt19937 random(3);
  const auto targets = clustered_targets(30, random);
  const FlightModel map = model_of(draw_flight("a", targets, {}, random), 4, 3.0);
  const std::vector<Eigen::Vector3d> elsewhere{targets[0] + Eigen::Vector3d(9.0, 6.0, 0.0),
                                               targets[0] + Eigen::Vector3d(9.0, 13.0, 0.0)};
  const FlightModel other = model_of(draw_flight("b", elsewhere, {}, random), 4, 3.0);
  const auto objects = associate({flight_to_associate(0, map, std::vector<int>(30, 0)),
                                  flight_to_associate(1, other, std::vector<int>(2, 0))},
                                 FusionConfig{});
  EXPECT_EQ(objects.size(), 32U);
}

TEST(Association, TheSameClassIsPreferred) {
  std::mt19937 random(5);
  FlightErrors errors;
  errors.own_m = 0.3;
  const std::vector<Eigen::Vector3d> targets{{0, 0, 0}, {0.7, 0, 0}, {20, 0, 0}, {0, 20, 0}, {20, 20, 0}};
  int right = 0;
  for (int i = 0; i < 50; ++i) {
    const FlightModel a = model_of(draw_flight("a", targets, errors, random), 4, 3.0);
    const FlightModel b = model_of(draw_flight("b", targets, errors, random), 4, 3.0);
    const std::vector<int> classes{1, 2, 3, 3, 3};
    right += is_right(associate({flight_to_associate(0, a, classes), flight_to_associate(1, b, classes)},
                                FusionConfig{}),
                      5)
                 ? 1
                 : 0;
  }
  EXPECT_GE(right, 45);
}

}  // namespace
}  // namespace geoloc
