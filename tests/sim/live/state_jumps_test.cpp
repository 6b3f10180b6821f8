// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/state_jumps.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/state/state_provider.hpp"
#include "sim/flights_for_test.hpp"
#include "sim/live/heard_messages.hpp"

namespace geoloc::sim {
namespace {

struct Told {
  std::vector<AttitudeSample> attitudes, from_quaternions;
  std::vector<PositionSample> positions;
};

Told told_by(const Flight& flight) {
  Told told;
  hear_messages(flight, [&](HostTime, const io::Message& message) {
    if (const auto* attitude = std::get_if<io::AttitudeMessage>(&message))
      (attitude->from_quaternion ? told.from_quaternions : told.attitudes).push_back(attitude->sample);
    if (const auto* position = std::get_if<PositionSample>(&message)) told.positions.push_back(*position);
  });
  return told;
}

/// What a receiver notices in the order of the stamps.
StateProvider::Counters notice(const Flight& flight) {
  const Told told = told_by(flight);
  StateProvider provider(StateConfig{});
  auto position = told.positions.begin();
  for (const AttitudeSample& attitude : told.attitudes) {
    for (; position != told.positions.end() && position->time <= attitude.time; ++position)
      provider.add(*position);
    provider.add(attitude);
  }
  return provider.counters();
}

/// A fast vehicle turns faster, and slow telemetry leaves more time for it. Four times as fast, the recorded
/// paths take sixteen times the acceleration, more than vehicles have: only many samples show it.
TEST(StateJumps, AreSeenWhereTheyAreAndNowhereElse) {
  for (const char* const name : {"stock_path1", "stock_path6", "gnss_path2", "gnss_path4"}) {
    const Flight recorded = load(name);
    for (const double speed : {1.0, 4.0}) {
      const Flight flight = at_speed(recorded, speed);
      for (const double rate_hz : {1.0, 2.0, 5.0, 10.0, 40.0}) {
        if (speed > 1.0 && rate_hz < 10.0) continue;
        SCOPED_TRACE(std::string(name) + " at " + std::to_string(speed) + ", " + std::to_string(rate_hz));
        const auto none = notice(at_telemetry_rate(flight, rate_hz));
        EXPECT_EQ(none.yaw_steps + none.position_steps + none.height_steps + none.home_moves, 0U);
        if (speed > 1.0 || rate_hz < 2.0) continue;
        const auto jumped = [&](const char* jump) {
          return notice(with_jump(at_telemetry_rate(flight, rate_hz), state_jump(jump, flight.truth)));
        };
        EXPECT_EQ(jumped("yaw").yaw_steps, 1U);
        EXPECT_EQ(jumped("reset").position_steps, 1U);
        EXPECT_EQ(jumped("glitch").position_steps, 2U);
        EXPECT_EQ(jumped("height").height_steps, 1U);
        EXPECT_EQ(jumped("home").home_moves, 1U);
      }
    }
  }
}

/// What is told while the jump lasts, and nothing else, differs by the jump.
void expect_jump(const Flight& recorded, const StateJump& jump) {
  const Told before = told_by(recorded), after = told_by(with_jump(recorded, jump));
  const LocalFrame& frame = recorded.truth.frame();
  const auto lasts_at = [&](VehicleTime time) { return time >= jump.when.begin && time < jump.when.end; };
  ASSERT_EQ(before.positions.size(), after.positions.size());
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    const PositionSample &was = before.positions[i], &is = after.positions[i];
    const double share = lasts_at(was.time) ? 1.0 : 0.0;
    const Eigen::Vector2d moved =
        frame.to_local(is.position).position_in_enu - frame.to_local(was.position).position_in_enu;
    ASSERT_LT((moved - share * jump.position_in_enu.head<2>()).norm(), 0.3) << i;  // degrees are 0.5 % longer
    ASSERT_NEAR(*is.height_msl_m - *was.height_msl_m, share * jump.position_in_enu.z(), 2e-3);
    ASSERT_NEAR(is.height_above_home_m - was.height_above_home_m,
                share * (jump.position_in_enu.z() - jump.home_up_m), 2e-3);
  }
  const auto expect_turned = [&](const std::vector<AttitudeSample>& was,
                                 const std::vector<AttitudeSample>& is) {
    ASSERT_EQ(was.size(), is.size());
    for (std::size_t i = 0; i < was.size(); ++i) {
      const double turned_rad = lasts_at(was[i].time) ? jump.yaw_deg * kRadPerDeg : 0.0;
      ASSERT_NEAR(wrap_to_pi(is[i].angles.yaw_rad - was[i].angles.yaw_rad - turned_rad), 0.0, 1e-5) << i;
      ASSERT_NEAR(is[i].angles.roll_rad, was[i].angles.roll_rad, 1e-5);
      ASSERT_NEAR(is[i].angles.pitch_rad, was[i].angles.pitch_rad, 1e-5);
    }
  };
  expect_turned(before.attitudes, after.attitudes);
  expect_turned(before.from_quaternions, after.from_quaternions);
}

TEST(StateJumps, ChangeWhatIsToldForAsLongAsTheyLastAndLeaveTheTruth) {
  const Flight recorded = load("stock_path2");
  for (const std::string& name : state_jump_names()) {
    SCOPED_TRACE(name);
    const StateJump jump = state_jump(name, recorded.truth);
    const TimeSpan survey = recorded.truth.survey();
    EXPECT_GT(jump.when.begin, survey.begin);
    EXPECT_LT(jump.when.begin, survey.end);
    expect_jump(recorded, jump);
    const VehicleTime later = jump.when.begin + from_seconds(2.0);
    EXPECT_EQ(with_jump(recorded, jump).truth.pose(later)->translation,
              recorded.truth.pose(later)->translation);
  }
}

TEST(StateJumps, OfNoNameAreRefusedWithThoseThereAre) {
  const Flight recorded = load("stock_path1");
  try {
    state_jump("leap", recorded.truth);
    FAIL();
  } catch (const std::invalid_argument& error) {
    for (const std::string& name : state_jump_names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace geoloc::sim
