// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "geoloc/io/mavlink/clock_mapping.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using Source = VehicleClockMap::Source;

constexpr HostTime kTakeOff{std::chrono::seconds{1'795'300'000}};
constexpr Duration kUpBefore = 100s;
constexpr Duration kStepAt = 60s;
/// What is not known of a map where nothing is in doubt: whole milliseconds, jitter, and the tolerance of the
/// contradictions.
constexpr Duration kGood = 60ms;

enum class RoundTrips { kEverySecond, kNone };

/// Ten attitudes and ten positions a second over a link that may hold back what it carries, one after
/// another. The vehicle's clock steps once.
class SteppingVehicle {
 public:
  using Hold = std::function<Duration(Duration since_start)>;

  SteppingVehicle(Duration step, RoundTrips round_trips, Hold hold = {})
      : step_(step), round_trips_(round_trips), hold_(std::move(hold)) {}

  Duration clock(Duration now) const { return kUpBefore + now + (now < kStepAt ? 0s : step_); }

  /// Everything that arrives in so long, and after each arrival a look at the map.
  void fly(Duration length, VehicleClockMap& map, const std::function<void(Duration now)>& look) {
    struct Arrival {
      Duration at;
      std::function<void()> deliver;
    };
    std::vector<Arrival> arrivals;
    for (Duration sent = 0s; sent < length; sent += 50ms) {
      const Duration stamp = std::chrono::floor<std::chrono::milliseconds>(clock(sent));
      const Duration at = arrival(sent);
      arrivals.push_back({at, [&map, stamp, at] { map.add_arrival(VehicleTime{stamp}, kTakeOff + at); }});
      if (round_trips_ == RoundTrips::kNone || sent % 1s != 0s) continue;
      const Duration read = arrival(sent), answered = arrival(read);
      arrivals.push_back({answered, [this, &map, sent, read, answered] {
                            map.add_round_trip(kTakeOff + sent, VehicleTime{clock(read)},
                                               kTakeOff + answered);
                          }});
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const Arrival& a, const Arrival& b) { return a.at < b.at; });
    for (const Arrival& next : arrivals) {
      next.deliver();
      look(next.at);
    }
  }

  Duration error(const VehicleClockMap& map, Duration now) const {
    return map.to_vehicle(kTakeOff + now)->time_since_epoch() - clock(now);
  }

 private:
  Duration arrival(Duration sent) {
    const Duration held = hold_ ? hold_(sent) : 0s;
    return sent + held + 5ms + from_seconds(std::exponential_distribution<double>(1.0 / 0.004)(random_));
  }

  Duration step_;
  RoundTrips round_trips_;
  Hold hold_;
  std::mt19937_64 random_{3};
};

class StepsOfTheVehicleClock : public ::testing::TestWithParam<double> {};

TEST_P(StepsOfTheVehicleClock, AreFollowedWithinAThirdOfASecondOfTheNextRoundTrip) {
  const Duration step = from_seconds(GetParam());
  SteppingVehicle vehicle(step, RoundTrips::kEverySecond);
  VehicleClockMap map;
  vehicle.fly(120s, map, [&](Duration now) {
    if (now < 5s || (now >= kStepAt && now < kStepAt + 1300ms)) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), 15ms) << seconds(now);
    ASSERT_EQ(map.doubt(), 0s) << seconds(now);
  });
  EXPECT_EQ(map.counts().steps, 1U);
  EXPECT_LE(std::chrono::abs(map.last_step() - step), 15ms);
  EXPECT_EQ(map.source(), Source::kRoundTrip);
}

TEST_P(StepsOfTheVehicleClock, LeaveNoWrongTimeThatIsNotInDoubt) {
  SteppingVehicle vehicle(from_seconds(GetParam()), RoundTrips::kEverySecond);
  VehicleClockMap map;
  vehicle.fly(120s, map, [&](Duration now) {
    // So long after the step, no frame from after it can be located yet: its vehicle state is to come.
    if (now >= kStepAt && now < kStepAt + 350ms) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood + map.doubt()) << seconds(now);
  });
}

TEST_P(StepsOfTheVehicleClock, ShowInArrivalsAlone) {
  const Duration step = from_seconds(GetParam());
  SteppingVehicle vehicle(step, RoundTrips::kNone);
  VehicleClockMap map;
  vehicle.fly(120s, map, [&](Duration now) {
    if (now >= kStepAt && now < kStepAt + 350ms) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood + map.doubt()) << seconds(now);
    const bool is_settled = now < kStepAt || now > kStepAt + 3s;
    if (is_settled) {
      ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood) << seconds(now);
    }
  });
  EXPECT_EQ(map.counts().steps, 1U);
  EXPECT_EQ(map.doubt(), 0s) << "proven by the quarter of a minute after it";
}

TEST_P(StepsOfTheVehicleClock, LeaveTimesBeforeThemWithoutAVehicleTime) {
  for (const RoundTrips round_trips : {RoundTrips::kEverySecond, RoundTrips::kNone}) {
    SteppingVehicle vehicle(from_seconds(GetParam()), round_trips);
    VehicleClockMap map;
    vehicle.fly(70s, map, [](Duration) {});
    EXPECT_FALSE(map.to_vehicle(kTakeOff + kStepAt - 10ms));
    EXPECT_TRUE(map.is_before_step(kTakeOff + kStepAt - 10ms));
    EXPECT_TRUE(map.to_vehicle(kTakeOff + kStepAt + 2s));
  }
}

INSTANTIATE_TEST_SUITE_P(VehicleClockMap, StepsOfTheVehicleClock,
                         ::testing::Values(-2.9, -1.0, -0.4, -0.3, 0.3, 0.4, 1.0, 2.9, 20.0));

/// Every few seconds the link carries nothing for a while; then everything comes at once.
Duration queue_of_radio(Duration sent) {
  const Duration phase = sent % 7s, held_until = 1400ms;
  return phase < held_until ? held_until - phase : 0s;
}

bool is_crowded(Duration sent) {
  return sent % 20s > 10s && sent % 20s < 18s;
}

/// For eight seconds in twenty all is late, by now more, now less.
Duration restless_crowd(Duration sent) {
  return is_crowded(sent) ? 300ms + 100ms * (sent / 700ms % 7) : 0s;
}

/// The same, but the luckiest of any moment by two thirds of a second.
Duration steady_crowd(Duration sent) {
  return is_crowded(sent) ? 660ms + 40ms * (sent / 50ms % 5) : 0s;
}

class CrowdedLinks : public ::testing::TestWithParam<Duration (*)(Duration)> {};

TEST_P(CrowdedLinks, AreNoSteps) {
  for (const RoundTrips round_trips : {RoundTrips::kEverySecond, RoundTrips::kNone}) {
    SteppingVehicle vehicle(0s, round_trips, GetParam());
    VehicleClockMap map;
    vehicle.fly(180s, map, [&](Duration now) {
      if (now < 20s) return;
      ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood) << seconds(now);
    });
    EXPECT_EQ(map.counts().steps, 0U);
  }
}

TEST_P(CrowdedLinks, HideNoStepForLong) {
  for (const double step_s : {-1.0, -0.4, 0.4, 1.0}) {
    SteppingVehicle vehicle(from_seconds(step_s), RoundTrips::kEverySecond, GetParam());
    VehicleClockMap map;
    vehicle.fly(180s, map, [&](Duration now) {
      if (now < 20s || (now >= kStepAt && now < kStepAt + 12s)) return;
      ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood) << step_s << " " << seconds(now);
    });
    EXPECT_EQ(map.counts().steps, 1U) << step_s;
  }
}

INSTANTIATE_TEST_SUITE_P(VehicleClockMap, CrowdedLinks, ::testing::Values(&queue_of_radio, &restless_crowd),
                         [](const auto& link) { return link.index == 0 ? "Queue" : "RestlessCrowd"; });

TEST(VehicleClockMap, ACrowdedLinkThatLooksLikeAStepLeavesTheMapInDoubt) {
  SteppingVehicle vehicle(0s, RoundTrips::kNone, &steady_crowd);
  VehicleClockMap map;
  vehicle.fly(180s, map, [&](Duration now) {
    if (now % 20s > 10s && now % 20s < 11s) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood + map.doubt()) << seconds(now);
  });
}

TEST(VehicleClockMap, RoundTripsTellACrowdedLinkFromAStep) {
  SteppingVehicle vehicle(0s, RoundTrips::kEverySecond, &steady_crowd);
  VehicleClockMap map;
  vehicle.fly(180s, map, [&](Duration now) {
    if (now < 5s) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood) << seconds(now);
  });
  EXPECT_EQ(map.counts().steps, 0U);
}

TEST(VehicleClockMap, OneStrayStampIsNoStep) {
  SteppingVehicle vehicle(0s, RoundTrips::kEverySecond);
  VehicleClockMap map;
  int arrivals = 0;
  vehicle.fly(60s, map, [&](Duration now) {
    if (++arrivals % 100 == 0) map.add_arrival(VehicleTime{vehicle.clock(now) + 700ms}, kTakeOff + now);
    if (now < 5s) return;
    ASSERT_LE(std::chrono::abs(vehicle.error(map, now)), kGood) << seconds(now);
  });
  EXPECT_EQ(map.counts().steps, 0U);
}

TEST(VehicleClockMap, RoundTripsOfAClockThatIsSlightlyAnotherAreLeftToThemselves) {
  SteppingVehicle vehicle(0s, RoundTrips::kNone);
  VehicleClockMap map;
  int arrivals = 0;
  vehicle.fly(60s, map, [&](Duration now) {
    if (++arrivals % 20 != 0) return;
    map.add_round_trip(kTakeOff + now - 4ms, VehicleTime{vehicle.clock(now) - 500ms}, kTakeOff + now);
  });
  EXPECT_EQ(map.source(), Source::kArrival);
  EXPECT_EQ(map.counts().steps, 0U);
}

}  // namespace
}  // namespace geoloc::io
