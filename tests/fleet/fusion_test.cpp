// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fleet/synthetic_fleet.hpp"

namespace geoloc {
namespace {

using testing::clustered_targets;
using testing::draw_fleet;
using testing::draw_flight;
using testing::flight_name;
using testing::FlightErrors;
using testing::MapScore;
using testing::score_map;

constexpr int kSeeds = 20, kManySeeds = 200;

/// To the bit.
void expect_same(const FusedMap& a, const FusedMap& b) {
  ASSERT_EQ(a.objects.size(), b.objects.size());
  ASSERT_EQ(a.flights.size(), b.flights.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].id, b.objects[i].id);
    EXPECT_EQ(a.objects[i].position_in_enu, b.objects[i].position_in_enu);
    EXPECT_EQ(a.objects[i].covariance, b.objects[i].covariance);
    EXPECT_EQ(a.objects[i].existence, b.objects[i].existence);
    EXPECT_EQ(a.objects[i].hits, b.objects[i].hits);
  }
  for (std::size_t i = 0; i < a.flights.size(); ++i) {
    EXPECT_EQ(a.flights[i].identity.flight, b.flights[i].identity.flight);
    EXPECT_EQ(a.flights[i].identity.sequence, b.flights[i].identity.sequence);
    EXPECT_EQ(a.flights[i].verdict, b.flights[i].verdict);
    EXPECT_EQ(a.flights[i].common_error_m, b.flights[i].common_error_m);
  }
}

/// Eight flights that each saw most of 30 clustered targets.
Fleet any_fleet(std::size_t flights = 8, unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto targets = clustered_targets(30, random);
  return draw_fleet(flights, targets, {}, random, 0.8);
}

TEST(Fleet, TheOrderOfMessagesMakesNoDifference) {
  std::vector<FlightSummary> messages;
  for (const auto& [name, summary] : any_fleet()) {
    FlightSummary older = summary;
    older.objects.resize(3);
    older.shared_error = summary.shared_error.topRows(9).eval();
    older.identity.sequence = 0;
    messages.push_back(older);
    messages.push_back(summary);
  }
  const FusedMap expected = fuse(any_fleet());
  std::mt19937 random(5);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(messages.begin(), messages.end(), random);
    Fleet fleet;
    for (const FlightSummary& message : messages) take(message, fleet);
    expect_same(fuse(fleet), expected);
  }
}

TEST(Fleet, RepeatedMessagesChangeNothing) {
  Fleet fleet = any_fleet();
  const FusedMap expected = fuse(fleet);
  for (int i = 0; i < 3; ++i) {
    for (const auto& [name, summary] : any_fleet()) EXPECT_FALSE(take(summary, fleet));
  }
  expect_same(fuse(fleet), expected);
}

/// Fleets that were gathered apart, and put together in whatever way.
TEST(Fleet, BatchesMayBePutTogetherInAnyWay) {
  const Fleet all = any_fleet(9);
  std::vector<Fleet> batches(3);
  std::size_t next = 0;
  for (const auto& [name, summary] : all) take(summary, batches[next++ % 3]);
  const auto joined = [](Fleet a, const Fleet& b) {
    for (const auto& [name, summary] : b) take(summary, a);
    return a;
  };
  const FusedMap expected = fuse(all);
  expect_same(fuse(joined(joined(batches[0], batches[1]), batches[2])), expected);
  expect_same(fuse(joined(batches[0], joined(batches[1], batches[2]))), expected);
  expect_same(fuse(joined(joined(batches[2], batches[0]), batches[1])), expected);
}

TEST(Fuse, AnEmptyFleetIsAnEmptyMap) {
  const FusedMap map = fuse({});
  EXPECT_FALSE(map.frame);
  EXPECT_TRUE(map.objects.empty());
}

TEST(Fuse, AFlightWithoutObjectsIsAlone) {
  Fleet fleet = any_fleet(3);
  FlightSummary empty;
  testing::set_name("nothing", empty);
  empty.origin = testing::kFleetOrigin;
  take(empty, fleet);
  const FusedMap map = fuse(fleet);
  EXPECT_EQ(map.flights.back().verdict, FlightVerdict::kAlone);
  EXPECT_EQ(map.objects.size(), fuse(any_fleet(3)).objects.size());
}

TEST(Fuse, OneFlightIsTheMap) {
  const Fleet fleet = any_fleet(1);
  const FlightSummary& flight = fleet.begin()->second;
  const FusedMap map = fuse(fleet);
  ASSERT_EQ(map.objects.size(), flight.objects.size());
  EXPECT_EQ(map.flights[0].verdict, FlightVerdict::kAlone);
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    EXPECT_LT((map.objects[i].position_in_enu - flight.objects[i].position_in_enu).norm(), 1e-6);
    const Eigen::Matrix3d off = map.objects[i].covariance - flight.covariance(i);
    EXPECT_LT(off.topRows<2>().norm(), 1e-9);  // heights have home's error besides
  }
}

/// Independent offsets average out: N flights know the place of the map by sqrt(N) better than one, and say
/// so.
TEST(Fuse, TheCommonErrorShrinksWithTheRootOfTheFlights) {
  constexpr int kMaps = 60;
  const FlightErrors errors;
  for (const std::size_t flights : {2U, 4U, 8U, 16U}) {
    double squares = 0.0, stated = 0.0, nees = 0.0;
    for (unsigned seed = 0; seed < kMaps; ++seed) {
      std::mt19937 random(100 + seed);
      const auto targets = clustered_targets(30, random);
      const Fleet fleet = draw_fleet(flights, targets, errors, random);
      const FusedMap map = fuse(fleet);
      const MapScore score = score_map(map, fleet, targets);
      EXPECT_EQ(score.found, 30U) << flights << " flights, seed " << seed;
      EXPECT_EQ(score.extra, 0U) << flights << " flights, seed " << seed;
      squares += 0.5 * score.mean_error_m.squaredNorm() / kMaps;
      stated += 0.5 * map.objects[0].covariance.topLeftCorner<2, 2>().trace() / kMaps;
      nees += 0.5 * score.nees / kMaps;
    }
    const double expected_m = errors.offset_m / std::sqrt(static_cast<double>(flights));
    EXPECT_NEAR(std::sqrt(squares), expected_m, 0.2 * expected_m) << flights;
    EXPECT_NEAR(std::sqrt(stated), expected_m, 0.15 * expected_m) << flights;
    EXPECT_GT(nees, 0.5) << flights;
    EXPECT_LT(nees, 1.5) << flights;
  }
}

/// Objects 1.2 m from each other, seen by flights that are off by as much.
TEST(Fuse, FindsWhichObjectsAreOneInClusters) {
  double fused = 0.0, single = 0.0;
  for (unsigned seed = 0; seed < kManySeeds; ++seed) {
    std::mt19937 random(seed);
    const auto targets = clustered_targets(30, random);
    const Fleet fleet = draw_fleet(8, targets, {}, random);
    const MapScore score = score_map(fuse(fleet), fleet, targets);
    EXPECT_EQ(score.found, 30U) << seed;
    EXPECT_EQ(score.extra, 0U) << seed;
    EXPECT_EQ(score.merged, 0U) << seed;
    fused += score.rmse_m * score.rmse_m / kManySeeds;
    const MapScore alone = score_map(fuse({*fleet.begin()}), fleet, targets);
    single += alone.rmse_m * alone.rmse_m / kManySeeds;
  }
  EXPECT_LT(std::sqrt(fused), 0.36);
  EXPECT_GT(std::sqrt(single), 0.8);
  RecordProperty("rmse_fused_m", std::to_string(std::sqrt(fused)));
  RecordProperty("rmse_single_m", std::to_string(std::sqrt(single)));
}

TEST(Fuse, NamesTheFlightThatIsFiveMetresOff) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    const auto targets = clustered_targets(30, random);
    Fleet fleet = draw_fleet(8, targets, {}, random);
    const std::string poisoned = flight_name(seed % 8);
    testing::move_east(5.0, fleet.at(poisoned));
    const FusedMap map = fuse(fleet);
    for (const FusedFlight& flight : map.flights) {
      const bool is_poisoned = flight.identity.flight == poisoned;
      EXPECT_EQ(flight.verdict, is_poisoned ? FlightVerdict::kQuarantined : FlightVerdict::kFused) << seed;
      EXPECT_EQ(flight.reason.empty(), !is_poisoned);
    }
    const MapScore score = score_map(map, fleet, targets);
    EXPECT_EQ(score.found, 30U) << seed;
    EXPECT_EQ(score.extra, 0U) << seed;
    Fleet honest = fleet;
    honest.erase(poisoned);
    const FusedMap without = fuse(honest);
    ASSERT_EQ(map.objects.size(), without.objects.size());
    for (std::size_t i = 0; i < map.objects.size(); ++i)
      EXPECT_LT((map.objects[i].position_in_enu - without.objects[i].position_in_enu).head<2>().norm(), 1e-3);
  }
}

TEST(Fuse, NoHonestFlightIsQuarantined) {
  std::size_t flights = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    for (const FusedFlight& flight : fuse(any_fleet(8, 500 + seed)).flights) {
      EXPECT_EQ(flight.verdict, FlightVerdict::kFused) << flight.reason;
      ++flights;
    }
  }
  EXPECT_EQ(flights, 400U);
}

TEST(Fuse, OfTwoFlightsThatDisagreeNeitherIsCondemned) {
  std::mt19937 random(4);
  const auto targets = clustered_targets(30, random);
  Fleet fleet = draw_fleet(2, targets, {}, random);
  testing::move_east(7.0, fleet.at(flight_name(0)));
  const FusedMap map = fuse(fleet);
  for (const FusedFlight& flight : map.flights) {
    EXPECT_EQ(flight.verdict, FlightVerdict::kDisputed);
    EXPECT_NE(flight.reason.find("third flight"), std::string::npos);
  }
}

TEST(Fuse, LeavesOutWhatBeganFarAway) {
  Fleet fleet = any_fleet(3);
  FlightSummary far = fleet.begin()->second;
  testing::set_name("zz-far", far);
  far.origin.latitude_deg += 1.0;
  take(far, fleet);
  const FusedMap map = fuse(fleet);
  EXPECT_EQ(map.flights.back().verdict, FlightVerdict::kTooFar);
  EXPECT_NE(map.flights.back().reason.find("111 km"), std::string::npos) << map.flights.back().reason;
  EXPECT_EQ(map.objects.size(), fuse(any_fleet(3)).objects.size());
}

/// The frame and the home that a flight counts from are its own affair.
TEST(Fuse, FlightsMayBeginElsewhere) {
  const Fleet fleet = any_fleet(6);
  Fleet moved;
  double shift_deg = 0.0;
  for (const auto& [name, summary] : fleet) {
    const LocalFrame frame({testing::kFleetOrigin.latitude_deg + shift_deg,
                            testing::kFleetOrigin.longitude_deg - 2.0 * shift_deg});
    FlightSummary other = transformed_to(frame, summary);
    other.home_height_msl_m = *summary.home_height_msl_m + 300.0 * shift_deg;
    for (FlightSummary::Object& object : other.objects) object.position_in_enu.z() -= 300.0 * shift_deg;
    take(other, moved);
    shift_deg += 0.03;
  }
  const FusedMap expected = fuse(fleet), map = fuse(moved);
  ASSERT_EQ(map.objects.size(), expected.objects.size());
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    EXPECT_LT((map.objects[i].position_in_enu - expected.objects[i].position_in_enu).norm(), 1e-4);
    EXPECT_LT((map.objects[i].covariance - expected.objects[i].covariance).norm(), 1e-3);
  }
}

FlightSummary only(FlightSummary summary, std::size_t begin, std::size_t end) {
  const std::vector<FlightSummary::Object> all = summary.objects;
  summary.objects.assign(all.begin() + static_cast<std::ptrdiff_t>(begin),
                         all.begin() + static_cast<std::ptrdiff_t>(end));
  summary.shared_error =
      summary.shared_error
          .middleRows(3 * static_cast<Eigen::Index>(begin), 3 * static_cast<Eigen::Index>(end - begin))
          .eval();
  return summary;
}

/// Two flights without an object in common become neighbours by a third that saw objects of both.
TEST(Fuse, AFlightConnectsOthers) {
  std::mt19937 random(8);
  const auto targets = clustered_targets(36, random);
  Fleet fleet;
  take(only(draw_flight("a", targets, {}, random), 0, 18), fleet);
  take(only(draw_flight("b", targets, {}, random), 18, 36), fleet);
  EXPECT_EQ(fuse(fleet).flights[0].verdict, FlightVerdict::kAlone);
  take(only(draw_flight("c", targets, {}, random), 9, 27), fleet);
  const FusedMap map = fuse(fleet);
  for (const FusedFlight& flight : map.flights) EXPECT_EQ(flight.verdict, FlightVerdict::kFused);
  const MapScore score = score_map(map, fleet, targets);
  EXPECT_EQ(score.found, 36U);
  EXPECT_EQ(score.extra, 0U);
}

/// One sees two objects nearer than the noise; the others see one of them each. Whatever the numbers say, the
/// two that were seen side by side stay two.
TEST(Fuse, WhatAFlightSawSideBySideIsNeverOne) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    auto targets = clustered_targets(12, random);
    targets.push_back(targets.back() + Eigen::Vector3d(0.05, 0.0, 0.0));
    FlightSummary both = draw_flight("a", targets, {}, random);
    both.apart = {{11, 12}};
    Fleet fleet;
    take(both, fleet);
    targets.pop_back();
    for (std::size_t i = 0; i < 3; ++i) take(draw_flight(flight_name(i), targets, {}, random), fleet);
    std::size_t with_both = 0;
    for (const FusedObject& object : fuse(fleet).objects) {
      const auto count = std::count_if(object.contributions.begin(), object.contributions.end(),
                                       [](const Contribution& c) { return c.flight == 0 && c.object >= 11; });
      EXPECT_LE(count, 1);
      with_both += static_cast<std::size_t>(count);
    }
    EXPECT_EQ(with_both, 2U);
  }
}

/// More unknowns than are allowed: the least of each flight become noise, and the map stays honest.
TEST(Fuse, StaysHonestWhereSharedErrorsAreLeftOut) {
  FusionConfig config;
  config.most_unknowns = 24;
  double nees = 0.0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    const auto targets = clustered_targets(30, random);
    const Fleet fleet = draw_fleet(8, targets, {}, random);
    const MapScore score = score_map(fuse(fleet, config), fleet, targets);
    EXPECT_EQ(score.found, 30U);
    nees += 0.5 * score.nees / kSeeds;
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 1.5);
}

TEST(Fuse, RefusesSettingsThatCannotBe) {
  FusionConfig config;
  config.gate = 0.0;
  config.most_unknowns = 0;
  EXPECT_EQ(config.problems().size(), 2U);
  EXPECT_THROW(fuse({}, config), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
