// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/clock_mapping.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <random>
#include <string>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using Source = VehicleClockMap::Source;

constexpr HostTime kStart{std::chrono::seconds{1'795'300'000}};
constexpr Duration kBootedBefore = 100s;  // kStart

/// A vehicle whose clock drifts, behind a link with jitter.
struct Link {
  const char* name;
  Duration up;
  Duration down;
  double jitter_ms;  ///< mean of an exponential, each way
  double drift_ppm;
};

void PrintTo(const Link& link, std::ostream* out) {
  *out << link.name;
}

class SimulatedVehicle {
 public:
  explicit SimulatedVehicle(const Link& link) : link_(link) {}

  VehicleTime clock(HostTime now) const {
    const double drift_ns = 1e-6 * link_.drift_ppm * static_cast<double>((now - kStart).count());
    return VehicleTime{kBootedBefore + (now - kStart) + Duration{std::llround(drift_ns)}};
  }

  void send_round_trip(VehicleClockMap& map, HostTime sent_at) {
    const HostTime heard_at = sent_at + link_.up + jitter();
    map.add_round_trip(sent_at, clock(heard_at), heard_at + link_.down + jitter());
  }

  /// Sends a time stamp in whole milliseconds, as MAVLink does.
  void send_stamp(VehicleClockMap& map, HostTime sent_at) {
    const VehicleTime stamp{std::chrono::floor<std::chrono::milliseconds>(clock(sent_at).time_since_epoch())};
    map.add_arrival(stamp, sent_at + link_.down + jitter());
  }

  Duration error(const VehicleClockMap& map, HostTime now) const { return *map.to_vehicle(now) - clock(now); }

 private:
  Duration jitter() {
    if (link_.jitter_ms == 0.0) return 0ns;
    return from_seconds(1e-3 * std::exponential_distribution<double>(1.0 / link_.jitter_ms)(random_));
  }

  Link link_;
  std::mt19937_64 random_{1};
};

class RegimesOfLinks : public ::testing::TestWithParam<Link> {};

TEST_P(RegimesOfLinks, RoundTripErrorStaysWithinItsBound) {
  const Link& link = GetParam();
  SimulatedVehicle vehicle(link);
  VehicleClockMap map;
  const Duration unequal_ways = (link.up - link.down) / 2;
  for (int second = 0; second < 3 * 3600; ++second) {
    const HostTime now = kStart + std::chrono::seconds{second};
    vehicle.send_round_trip(map, now);
    if (map.source() != Source::kRoundTrip) continue;
    const HostTime later = now + 1s;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, later)), *map.error_bound() + 1s / 5000) << second;
    if (second < 64) continue;
    // Half the difference of the two delays remains, plus the residuals of jitter and drift.
    const Duration remainder = std::chrono::abs(vehicle.error(map, later) - unequal_ways);
    ASSERT_LE(seconds(remainder), 1e-3 * (0.4 + 0.3 * link.jitter_ms) + 1e-5 * std::abs(link.drift_ppm))
        << second;
  }
}

TEST_P(RegimesOfLinks, ArrivalErrorIsTheSmallestDelayAndLittleDrift) {
  const Link& link = GetParam();
  SimulatedVehicle vehicle(link);
  VehicleClockMap map;
  const Duration window_drift = from_seconds(16e-6 * std::abs(link.drift_ppm));
  for (int tick = 0; tick < 20 * 3 * 3600; ++tick) {
    const HostTime now = kStart + tick * 50ms;
    vehicle.send_stamp(map, now);
    if (tick < 400) continue;
    const Duration lateness = -vehicle.error(map, now);
    ASSERT_GE(lateness, link.down - window_drift) << tick;
    ASSERT_LE(lateness, link.down + window_drift + from_seconds(1e-3 + 0.1e-3 * link.jitter_ms)) << tick;
  }
  EXPECT_EQ(map.source(), Source::kArrival);
  EXPECT_FALSE(map.error_bound());
}

TEST_P(RegimesOfLinks, TheSourceChangesOnce) {
  SimulatedVehicle vehicle(GetParam());
  VehicleClockMap map;
  std::mt19937 random(2);
  int changes = 0;
  Source before = Source::kNone;
  for (int tick = 0; tick < 20 * 3600; ++tick) {
    const HostTime now = kStart + tick * 50ms;
    vehicle.send_stamp(map, now);
    if (tick > 100 && tick % 20 == 0 && random() % 10 != 0) vehicle.send_round_trip(map, now);
    if (map.source() != before) ++changes;
    before = map.source();
  }
  EXPECT_EQ(changes, 2) << "to arrivals, then to round trips";
  EXPECT_EQ(map.source(), Source::kRoundTrip);
}

INSTANTIATE_TEST_SUITE_P(
    VehicleClockMap, RegimesOfLinks,
    ::testing::Values(Link{"Wire", 1ms, 1ms, 0.0, 0.0}, Link{"Network", 3ms, 3ms, 2.0, 20.0},
                      Link{"Jitter", 5ms, 5ms, 20.0, -30.0}, Link{"Unequal", 40ms, 10ms, 5.0, 10.0},
                      Link{"Fast", 2ms, 2ms, 1.0, 100.0}, Link{"Slow", 2ms, 2ms, 1.0, -100.0}),
    [](const auto& link) { return std::string(link.param.name); });

constexpr Link kGoodLink{"Good", 2ms, 2ms, 0.0, 0.0};

/// Four round trips, a tenth of a second apart.
void synchronise(VehicleClockMap& map, HostTime start) {
  SimulatedVehicle vehicle(kGoodLink);
  for (int i = 0; i < 4; ++i) vehicle.send_round_trip(map, start + i * 100ms);
}

TEST(VehicleClockMap, KnowsNothingAtFirst) {
  const VehicleClockMap map;
  EXPECT_FALSE(map.to_vehicle(kStart));
  EXPECT_FALSE(map.to_host(VehicleTime{100s}));
  EXPECT_FALSE(map.error_bound());
  EXPECT_EQ(map.source(), Source::kNone);
}

TEST(VehicleClockMap, IsItsOwnInverse) {
  VehicleClockMap map;
  synchronise(map, kStart);
  for (const Duration after : {0ns, 1ns, 123'456'789ns, Duration{24h}}) {
    EXPECT_EQ(map.to_host(*map.to_vehicle(kStart + after)), kStart + after);
  }
  EXPECT_EQ(map.to_vehicle(kStart), VehicleTime{kBootedBefore}) << "equal ways: exact";
}

TEST(VehicleClockMap, FallsBackToArrivalsWhenRoundTripsStop) {
  SimulatedVehicle vehicle(kGoodLink);
  VehicleClockMap map;
  synchronise(map, kStart);
  for (HostTime now = kStart; now < kStart + 29s; now += 100ms) vehicle.send_stamp(map, now);
  EXPECT_EQ(map.source(), Source::kRoundTrip);
  for (HostTime now = kStart + 29s; now < kStart + 32s; now += 100ms) vehicle.send_stamp(map, now);
  EXPECT_EQ(map.source(), Source::kArrival);
  synchronise(map, kStart + 40s);
  EXPECT_EQ(map.source(), Source::kRoundTrip);
}

TEST(VehicleClockMap, RefusesAndCountsWhatCannotBe) {
  constexpr HostTime kEarliest = HostTime::min(), kLatest = HostTime::max();
  constexpr VehicleTime kRemote{100s};
  VehicleClockMap map;
  map.add_round_trip(kStart, kRemote, kStart - 1ns);
  map.add_round_trip(kStart, kRemote, kStart + 1s + 1ns);
  map.add_round_trip(kEarliest, kRemote, kStart);
  map.add_round_trip(kStart, kRemote, kLatest);
  map.add_round_trip(kEarliest, kRemote, kLatest);
  map.add_round_trip(kLatest, kRemote, kEarliest);
  map.add_round_trip(kStart, VehicleTime::min(), kStart + 1ms);
  map.add_round_trip(kStart, VehicleTime::max(), kStart + 1ms);
  map.add_round_trip(kStart, VehicleTime{-1ns}, kStart + 1ms);
  EXPECT_EQ(map.counts().refused_round_trips, 9U);
  EXPECT_EQ(map.counts().round_trips, 0U);
  map.add_arrival(VehicleTime::max(), kStart);
  map.add_arrival(VehicleTime::min(), kStart);
  map.add_arrival(kRemote, kLatest);
  map.add_arrival(kRemote, kEarliest);
  EXPECT_EQ(map.counts().refused_arrivals, 4U);
  EXPECT_EQ(map.source(), Source::kNone);
  synchronise(map, kStart);
  EXPECT_FALSE(map.to_vehicle(kLatest));
  EXPECT_FALSE(map.to_host(VehicleTime::min()));
}

TEST(VehicleClockMap, IgnoresRoundTripsOnAnotherClockThanTheStamps) {
  SimulatedVehicle vehicle(kGoodLink);
  VehicleClockMap map;
  vehicle.send_stamp(map, kStart);
  for (int i = 0; i < 10; ++i) {  // another system that answers with its uptime of a day
    map.add_round_trip(kStart + i * 1s, VehicleTime{24h + i * 1s}, kStart + i * 1s + 2ms);
  }
  EXPECT_EQ(map.counts().refused_round_trips, 10U);
  EXPECT_EQ(map.source(), Source::kArrival);
}

TEST(VehicleClockMap, StampsOverruleRoundTripsThatCameFirst) {
  SimulatedVehicle vehicle(kGoodLink);
  VehicleClockMap map;
  for (int i = 0; i < 10; ++i)
    map.add_round_trip(kStart + i * 1s, VehicleTime{24h + i * 1s}, kStart + i * 1s + 2ms);
  EXPECT_EQ(map.source(), Source::kRoundTrip);
  vehicle.send_stamp(map, kStart + 10s);
  EXPECT_EQ(map.source(), Source::kArrival);
  EXPECT_LE(std::chrono::abs(vehicle.error(map, kStart + 11s)), 4ms);
}

TEST(VehicleClockMap, ForgetsTheClockOnRestartButNotItsCounts) {
  VehicleClockMap map;
  synchronise(map, kStart);
  map.restart();
  EXPECT_EQ(map.source(), Source::kNone);
  EXPECT_FALSE(map.to_vehicle(kStart));
  EXPECT_EQ(map.counts().round_trips, 4U);
}

class StepsOfTheHostClock : public ::testing::TestWithParam<Duration> {};

TEST_P(StepsOfTheHostClock, AreFollowedWithinTwentySeconds) {
  // The stamps of a real log do jump.
  SimulatedVehicle vehicle(kGoodLink);
  VehicleClockMap map;
  const Duration step = GetParam();
  for (Duration t = 0s; t < 120s; t += 100ms) {
    const HostTime then = kStart + t;
    const Duration shift = t < 60s ? 0s : step;
    map.add_arrival(vehicle.clock(then), then + 2ms + shift);
    if (t % 1s == 0s) map.add_round_trip(then + shift, vehicle.clock(then + 2ms), then + 4ms + shift);
    if (t < 60s || t > 80s) {
      ASSERT_LE(std::chrono::abs(*map.to_vehicle(then + shift) - vehicle.clock(then)), 3ms) << seconds(t);
    }
  }
  EXPECT_EQ(map.source(), Source::kRoundTrip);
}

INSTANTIATE_TEST_SUITE_P(VehicleClockMap, StepsOfTheHostClock,
                         ::testing::Values(Duration{10s}, Duration{-10s}, Duration{1h}, Duration{-1h}));

}  // namespace
}  // namespace geoloc::io
