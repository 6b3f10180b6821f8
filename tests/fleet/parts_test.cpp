// SPDX-License-Identifier: Apache-2.0
// Laws of flights that are told of in parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fleet/divided_flight.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc {
namespace {

using testing::DividedFlight;
using testing::draw_flight;

constexpr int kNodes = DividedFlight::kNodes;

/// 48 targets in two rows, no two nearer than 4 m.
std::vector<Eigen::Vector3d> rows_of_targets(std::mt19937& random) {
  std::uniform_real_distribution<double> around(-1.0, 1.0);
  std::vector<Eigen::Vector3d> targets;
  for (int i = 0; i < 48; ++i)
    targets.emplace_back((i % 2 == 0 ? -4.0 : 5.0) + around(random), 3.0 * i + around(random), 0.3 * (i % 5));
  return targets;
}

struct Flown {
  explicit Flown(unsigned seed) : random(seed), targets(rows_of_targets(random)), flight(targets, random) {}

  std::mt19937 random;
  std::vector<Eigen::Vector3d> targets;
  DividedFlight flight;
};

Fleet fleet_of(const std::vector<FlightSummary>& summaries) {
  Fleet fleet;
  for (const FlightSummary& summary : summaries) take(summary, fleet);
  return fleet;
}

const FusedObject* nearest(const FusedMap& map, const FusedObject& object) {
  const auto distance = [&](const FusedObject& other) {
    return (other.position_in_enu - object.position_in_enu).norm();
  };
  return &*std::min_element(map.objects.begin(), map.objects.end(),
                            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

/// Objects are where they are in the other map, and as well known.
void expect_same_map(const FusedMap& map, const FusedMap& expected) {
  ASSERT_EQ(map.objects.size(), expected.objects.size());
  for (const FusedObject& object : expected.objects) {
    const FusedObject& other = *nearest(map, object);
    EXPECT_LT((other.position_in_enu - object.position_in_enu).norm(), 1e-6) << object.id;
    EXPECT_LT((other.covariance - object.covariance).norm(), 1e-6) << object.id;
    EXPECT_EQ(other.hits, object.hits);
  }
}

TEST(Parts, OfAFlightHaveNoProblems) {
  const Flown flown(1);
  for (const FlightSummary& summary : {flown.flight.summary("a"), flown.flight.summary("a", 5, 9)})
    EXPECT_TRUE(summary.problems().empty()) << summary.problems().front();
}

/// The law that names this file: positions and covariances of all objects, to a micrometre.
TEST(Parts, HalvesOfAFlightFuseToTheFlight) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Flown flown(seed);
    const FusedMap whole = fuse(fleet_of({flown.flight.summary("whole")}));
    const FusedMap halves =
        fuse(fleet_of({flown.flight.summary("a", 0, 11), flown.flight.summary("b", 11, kNodes)}));
    expect_same_map(halves, whole);
    for (const FusedFlight& part : halves.flights) {
      EXPECT_EQ(part.parts, (std::vector<std::size_t>{0, 1}));
      EXPECT_EQ(part.verdict, FlightVerdict::kAlone);  // its other half is no witness
      EXPECT_EQ(part.shared_objects, 0U);
    }
  }
}

TEST(Parts, AsManyAsThereAreFuseToTheFlight) {
  for (unsigned seed = 10; seed < 13; ++seed) {
    const Flown flown(seed);
    expect_same_map(
        fuse(fleet_of({flown.flight.summary("c", 0, 7), flown.flight.summary("a", 7, 12),
                       flown.flight.summary("d", 12, 17), flown.flight.summary("b", 17, kNodes)})),
        fuse(fleet_of({flown.flight.summary("whole")})));
  }
}

/// Nothing is left out where a flight's end is far from its other half's start; the drift between is not
/// known.
TEST(Parts, MayBeFarApart) {
  const Flown flown(3);
  const FusedMap whole = fuse(fleet_of({flown.flight.summary("whole")}));
  const FusedMap parts =
      fuse(fleet_of({flown.flight.summary("a", 0, 8), flown.flight.summary("b", 16, kNodes)}));
  ASSERT_EQ(parts.flights[0].parts.size(), 2U);
  double chi2 = 0.0;
  for (const FusedObject& object : parts.objects) {
    const Eigen::Vector3d off = object.position_in_enu - nearest(whole, object)->position_in_enu;
    // What is known of less is known by no more, and differs by no more than that.
    const Eigen::Matrix3d more = object.covariance - nearest(whole, object)->covariance;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(more).eigenvalues().minCoeff(), -1e-9);
    chi2 += off.dot((more + 1e-6 * Eigen::Matrix3d::Identity()).inverse() * off) /
            static_cast<double>(parts.objects.size());
  }
  EXPECT_LT(chi2, 9.0);
}

TEST(Parts, AndOtherFlightsAreTheFlightAndTheOthers) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    Flown flown(seed);
    std::vector<FlightSummary> others;
    for (const char* const name : {"0", "m", "z"})
      others.push_back(draw_flight(name, flown.targets, {}, flown.random, 0.7));
    std::vector<FlightSummary> whole = others, halves = others;
    whole.push_back(flown.flight.summary("whole"));
    halves.push_back(flown.flight.summary("n", 0, 11));
    halves.push_back(flown.flight.summary("a", 11, kNodes));
    const FusedMap map = fuse(fleet_of(halves)), expected = fuse(fleet_of(whole));
    expect_same_map(map, expected);
    for (const FusedFlight& flight : map.flights) EXPECT_EQ(flight.verdict, FlightVerdict::kFused);
    const FusedFlight& first = map.flights[3];  // "n"
    EXPECT_EQ(first.identity.flight, "n");
    EXPECT_EQ(first.parts, (std::vector<std::size_t>{3, 1}));
    // What objects of both halves tell of the flight itself is taken for what others tell: it is little.
    EXPECT_NEAR(first.chi2, expected.flights[2].chi2, 0.02 * (1.0 + first.chi2));
  }
}

TEST(Parts, TheOrderAndRepeatsMakeNoDifference) {
  const Flown flown(7);
  const std::vector<FlightSummary> parts{flown.flight.summary("a", 0, 9), flown.flight.summary("b", 9, 16),
                                         flown.flight.summary("c", 16, kNodes)};
  const FusedMap expected = fuse(fleet_of(parts));
  for (const auto& order : {std::vector<std::size_t>{2, 0, 1, 0}, std::vector<std::size_t>{1, 2, 2, 0}}) {
    Fleet fleet;
    for (const std::size_t i : order) take(parts[i], fleet);
    const FusedMap map = fuse(fleet);
    ASSERT_EQ(map.objects.size(), expected.objects.size());
    for (std::size_t i = 0; i < map.objects.size(); ++i)
      EXPECT_EQ(map.objects[i].position_in_enu, expected.objects[i].position_in_enu);
  }
}

/// The receiver's offset is one, and is not known better by being told of twice.
TEST(Parts, DoNotCountTheReceiversOffsetTwice) {
  const Flown flown(5);
  const auto sigma_of = [](const std::vector<FlightSummary>& summaries) {
    return std::sqrt(fuse(fleet_of(summaries)).objects[24].covariance(0, 0));
  };
  const FlightSummary first = flown.flight.summary("a", 0, 12),
                      second = flown.flight.summary("b", 12, kNodes);
  FlightSummary stranger = second;
  stranger.part.reset();
  const double whole_m = sigma_of({flown.flight.summary("whole")});
  EXPECT_NEAR(sigma_of({first, second}), whole_m, 1e-6);
  EXPECT_LT(sigma_of({first, stranger}), 0.85 * whole_m);  // what two flights would claim
}

/// The whole flight is one witness, and is named as one.
TEST(Parts, AreQuarantinedTogether) {
  Flown flown(30);
  std::vector<FlightSummary> summaries;
  for (const char* const name : {"0", "m", "z"})
    summaries.push_back(draw_flight(name, flown.targets, {}, flown.random));
  summaries.push_back(flown.flight.summary("a", 0, 11));
  summaries.push_back(flown.flight.summary("b", 11, kNodes));
  for (std::size_t i = 3; i < 5; ++i) testing::move_east(6.0, summaries[i]);
  const FusedMap map = fuse(fleet_of(summaries));
  for (const FusedFlight& flight : map.flights)
    EXPECT_EQ(flight.verdict, flight.parts.empty() ? FlightVerdict::kFused : FlightVerdict::kQuarantined);
}

TEST(Parts, AreTwoFlightsWhereTheyAreSaidToBe) {
  const Flown flown(2);
  const auto are_joined = [](const FlightSummary& a, const FlightSummary& b) {
    return !fuse(fleet_of({a, b})).flights[0].parts.empty();
  };
  const FlightSummary first = flown.flight.summary("a", 0, 11),
                      second = flown.flight.summary("b", 11, kNodes);
  EXPECT_TRUE(are_joined(first, second));
  const auto changed = [&](auto change) {
    FlightSummary other = second;
    change(other);
    return other;
  };
  EXPECT_FALSE(are_joined(first, changed([](auto& s) { s.part.reset(); })));
  EXPECT_FALSE(are_joined(first, changed([](auto& s) { s.identity.vehicle = "other"; })));
  EXPECT_FALSE(are_joined(first, changed([](auto& s) { s.part->run.booted_at += std::chrono::seconds{4}; })));
  EXPECT_FALSE(are_joined(first, changed([](auto& s) { s.part->run.whole = "tuesday"; })));
  EXPECT_FALSE(are_joined(first, flown.flight.summary("b", 9, kNodes)));  // the same frames twice
  // The user has the last word, whatever the clocks say.
  FlightSummary named = first;
  named.part->run.whole = "tuesday";
  EXPECT_TRUE(are_joined(named, changed([](auto& s) {
                           s.part->run.whole = "tuesday";
                           s.identity.vehicle = "other";
                           s.part->run.booted_at += std::chrono::hours{1};
                         })));
}

/// A camera that was mounted anew makes another flight of it, and it is told.
TEST(Parts, ThatContradictEachOtherAreFlightsByThemselves) {
  const Flown flown(2);
  const FlightSummary first = flown.flight.summary("a", 0, 11);
  FlightSummary second = flown.flight.summary("b", 11, kNodes);
  for (FlightState::Unknown& unknown : second.part->state.unknowns) {
    if (unknown.which == FlightUnknown::kBoresightZ) unknown.mean += 0.2;
  }
  const FusedMap map = fuse(fleet_of({first, second}));
  for (const FusedFlight& flight : map.flights) {
    EXPECT_TRUE(flight.parts.empty());
    EXPECT_NE(flight.reason.find("contradict"), std::string::npos) << flight.reason;
  }
}

/// More unknowns than are allowed: the least of each part become noise, and no unknown is known better for
/// it.
TEST(Parts, StayHonestWhereSharedErrorsAreLeftOut) {
  const Flown flown(9);
  const Fleet fleet = fleet_of({flown.flight.summary("a", 0, 11), flown.flight.summary("b", 11, kNodes)});
  FusionConfig config;
  config.most_unknowns = 40;
  const FusedMap whole = fuse(fleet), cut = fuse(fleet, config);
  ASSERT_EQ(cut.objects.size(), whole.objects.size());
  for (const FusedObject& object : whole.objects)
    EXPECT_GT(nearest(cut, object)->covariance(0, 0), 0.8 * object.covariance(0, 0));
}

}  // namespace
}  // namespace geoloc
