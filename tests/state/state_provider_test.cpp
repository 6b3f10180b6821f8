// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/state_provider.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}
const Geodetic kHome{-22.906, -43.133};

PositionSample position(double time_s, double north_m, double up_m) {
  PositionSample sample;
  sample.time = at_s(time_s);
  sample.position = {kHome.latitude_deg + north_m / 110750.0, kHome.longitude_deg};
  sample.height_above_home_m = up_m;
  sample.height_msl_m = up_m + 10.0;
  return sample;
}

TEST(StateProvider, JoinsPositionAndAttitudeOfDifferentTimes) {
  StateProvider provider(StateConfig{});
  for (int i = 0; i <= 10; ++i) provider.add(position(0.1 * i, 5.0 * 0.1 * i, 20.0 + 0.1 * i));
  for (int i = 0; i <= 10; ++i)
    provider.add(AttitudeSample{at_s(0.03 + 0.1 * i), {0.01 * i, 0.0, 3.0 + 0.05 * i}});
  const auto state = provider.at(at_s(0.58));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->enu_from_body.translation.y(), 5.0 * 0.58, 2e-3);
  EXPECT_NEAR(state->enu_from_body.translation.z(), 20.58, 1e-9);
  EXPECT_NEAR(state->velocity_in_enu.y(), 5.0, 0.01);
  const EulerAngles angles = euler_angles(enu_from_ned() * state->enu_from_body.rotation);
  EXPECT_NEAR(angles.roll_rad, 0.055, 1e-6);
  EXPECT_NEAR(wrap_to_pi(angles.yaw_rad - 3.275), 0.0, 1e-6);  // across the wrap at pi
  EXPECT_NEAR(state->angular_velocity_in_body.z(), 0.5, 1e-3);
}

TEST(StateProvider, GivesNoStateWithoutBothQuantities) {
  StateProvider provider(StateConfig{});
  provider.add(position(0.0, 0, 20));
  provider.add(position(0.1, 0, 20));
  EXPECT_EQ(provider.at(at_s(0.05)).error(), NoState::kNoSamples);
}

TEST(StateProvider, KnowsNothingOfBeforeAReboot) {
  for (const bool is_position_first : {true, false}) {
    StateProvider provider(StateConfig{});
    for (int i = 0; i <= 10; ++i) {
      provider.add(position(0.1 * i, 0, 20));
      provider.add(AttitudeSample{at_s(0.1 * i), {}});
    }
    ASSERT_TRUE(provider.at(at_s(0.55)));
    provider.restart();
    EXPECT_EQ(provider.at(at_s(0.55)).error(), NoState::kNoSamples);
    for (int i = 0; i <= 10; ++i) {
      if (is_position_first) provider.add(position(0.1 * i, 0, 20));
      if (!is_position_first) provider.add(AttitudeSample{at_s(0.1 * i), {}});
    }
    EXPECT_EQ(provider.at(at_s(0.55)).error(), NoState::kNoSamples);
    EXPECT_EQ(provider.counters().reboots, 1U);
  }
}

TEST(StateProvider, DoesNotInterpolateAcrossAStepOfTheClock) {
  StateProvider provider(StateConfig{});
  const auto fly = [&](double begin_s, double height_m) {
    for (int i = 0; i < 10; ++i) {
      provider.add(position(begin_s + 0.1 * i, 0, height_m));
      provider.add(AttitudeSample{at_s(begin_s + 0.1 * i), {}});
    }
  };
  fly(5.0, 20);
  provider.on_clock_step();
  EXPECT_EQ(provider.counters().clock_steps, 1U);
  EXPECT_EQ(provider.counters().reboots, 0U);
  fly(5.6, 30);  // the clock stopped: the stamps of before come again
  EXPECT_FALSE(provider.at(at_s(5.55)));
  const auto state = provider.at(at_s(5.65));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->enu_from_body.translation.z(), 30.0, 1e-9);
}

TEST(StateProvider, StartsAfreshAfterAReboot) {
  StateProvider provider(StateConfig{});
  for (int i = 0; i < 50; ++i) {
    provider.add(position(200 + 0.1 * i, 0, 20));
    provider.add(AttitudeSample{at_s(200 + 0.1 * i), {}});
  }
  for (int i = 0; i < 10; ++i) {
    provider.add(position(5 + 0.1 * i, 0, 30));
    provider.add(AttitudeSample{at_s(5 + 0.1 * i), {}});
  }
  EXPECT_EQ(provider.counters().reboots, 1U);
  const auto state = provider.at(at_s(5.75));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->enu_from_body.translation.z(), 30.0, 1e-9);
  EXPECT_FALSE(provider.at(at_s(202.0)));
}

TEST(StateProvider, RefusesWhatIsNoNumberAndNoPlace) {
  StateProvider provider(StateConfig{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  provider.add(AttitudeSample{at_s(1), {nan, 0, 0}});
  PositionSample bad = position(1, 0, 20);
  bad.position.latitude_deg = 91.0;
  provider.add(bad);
  bad = position(1, 0, nan);
  provider.add(bad);
  provider.add(position(1, 0, 20));
  provider.add(position(1.1, 0, 20));
  bad = position(1.2, 0, 20);
  bad.position.longitude_deg = 10.0;  // the other side of the Atlantic
  provider.add(bad);
  EXPECT_EQ(provider.counters().invalid, 3U);
  EXPECT_EQ(provider.counters().too_far, 1U);
  EXPECT_EQ(provider.counters().positions, 2U);
}

TEST(StateProvider, RefusesAndCountsAnglesThatAreDegreesInPlaceOfRadians) {
  StateProvider provider(StateConfig{});
  for (const EulerAngles& angles :
       {EulerAngles{0, 0, 180.0}, EulerAngles{0, 0, -90.0}, EulerAngles{10.0, 0, 0}, EulerAngles{0, 2.0, 0}})
    provider.add(AttitudeSample{at_s(1), angles});
  EXPECT_EQ(provider.counters().out_of_range, 4U);
  EXPECT_EQ(provider.counters().attitudes, 0U);
  double time_s = 1.0;  // what autopilots send: yaw from -pi to pi, or from 0 to 2 pi; rounded to float
  for (const float yaw : {-3.14159274F, 3.14159274F, 6.28318548F, 0.0F})
    provider.add(AttitudeSample{at_s(time_s += 0.1), {3.14159274F, -1.57079637F, yaw}});
  EXPECT_EQ(provider.counters().out_of_range, 4U);
  EXPECT_EQ(provider.counters().attitudes, 4U);
}

TEST(StateProvider, IsSettledWhereBothQuantitiesHaveGoneBeyond) {
  StateProvider provider(StateConfig{});
  EXPECT_FALSE(provider.is_settled(at_s(1.0)));
  for (const double time_s : {0.9, 1.1}) provider.add(position(time_s, 0, 20));
  provider.add(AttitudeSample{at_s(1.0), {}});
  EXPECT_FALSE(provider.is_settled(at_s(1.0))) << "the sample of that time may be the last before";
  EXPECT_TRUE(provider.is_settled(at_s(0.99)));
  provider.add(AttitudeSample{at_s(1.05), {}});
  EXPECT_TRUE(provider.is_settled(at_s(1.0)));
  EXPECT_FALSE(provider.is_settled(at_s(1.07)));
}

TEST(StateProvider, TurnsNorthWithTheMeridian) {
  // 10 km east of the origin at 60 deg north, true north is 0.155 deg to the left of the frame's north.
  StateProvider provider(StateConfig{});
  PositionSample sample;
  sample.position = {60.0, 10.0};
  sample.height_above_home_m = 100.0;
  for (int i = 0; i < 2; ++i) {
    sample.time = at_s(0.1 * i);
    provider.add(sample);
  }
  for (int i = 2; i <= 4; ++i) {
    sample.time = at_s(i * 0.1);
    sample.position.longitude_deg = 10.0 + 10e3 / 55800.0;
    provider.add(sample);
    provider.add(AttitudeSample{sample.time, {0, 0, 0}});
  }
  const auto state = provider.at(at_s(0.35));
  ASSERT_TRUE(state);
  const Eigen::Vector3d nose = state->enu_from_body.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(nose.x(), nose.y()) * kDegPerRad, -0.155, 0.001);
}

TEST(StateProvider, RefusesPositionsBeyondTheReachOfOneFrame) {
  StateProvider provider(StateConfig{});
  provider.add(position(0.0, 0, 20));
  provider.add(position(0.1, 0, 20));
  provider.add(position(0.2, 199e3, 20));
  EXPECT_EQ(provider.counters().too_far, 0U);
  for (const double time_s : {0.3, 0.4}) provider.add(position(time_s, 202e3, 20));
  EXPECT_EQ(provider.counters().too_far, 2U);
  EXPECT_EQ(provider.counters().positions, 3U);
  EXPECT_EQ(provider.position_use(), StateProvider::PositionUse::kTooFar);
  EXPECT_EQ(provider.too_far_in_a_row(), 2U);
  provider.add(position(0.5, 0, 20));
  EXPECT_EQ(provider.position_use(), StateProvider::PositionUse::kTaken);
  EXPECT_EQ(provider.too_far_in_a_row(), 0U);
}

TEST(StateProvider, BeginsItsFrameWhereTwoPositionsAgree) {
  StateProvider provider(StateConfig{});
  EXPECT_EQ(provider.position_use(), StateProvider::PositionUse::kNone);
  const PositionSample far = position(0.0, 300e3, 20);
  provider.add(far);
  provider.add(far);  // the same once more is no second one
  EXPECT_EQ(provider.position_use(), StateProvider::PositionUse::kUnconfirmed);
  PositionSample antipode = position(0.1, 0, 20);
  antipode.position = {-kHome.latitude_deg, kHome.longitude_deg + 180.0};
  provider.add(antipode);
  for (int i = 2; i <= 10; ++i) {
    provider.add(position(0.1 * i, 5.0 * 0.1 * (i - 2), 20));
    provider.add(AttitudeSample{at_s(0.1 * i), {}});
  }
  EXPECT_EQ(provider.position_use(), StateProvider::PositionUse::kTaken);
  EXPECT_EQ(provider.local_frame()->origin().latitude_deg, kHome.latitude_deg);
  EXPECT_EQ(provider.counters().unconfirmed, 2U);
  EXPECT_EQ(provider.counters().too_far, 0U);
  const auto state = provider.at(at_s(0.25));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->enu_from_body.translation.y(), 0.25, 1e-2);
  EXPECT_EQ(state->steps.segment, 0U);
  EXPECT_EQ(provider.at(at_s(0.15)).error(), NoState::kTooOld) << "nothing is known from the false ones";
}

TEST(StateProvider, ForgetsAnUnconfirmedPositionWithTheClockItIsOf) {
  StateProvider provider(StateConfig{});
  provider.add(position(100.0, 0, 20));
  provider.restart();
  EXPECT_FALSE(provider.local_frame());
}

TEST(StateProvider, KeepsAFrameThatSomethingWasLocatedIn) {
  StateProvider provider(StateConfig{});
  provider.add(position(0.0, 0, 20));
  provider.keep_frame();
  provider.add(position(0.1, 300e3, 20));
  EXPECT_EQ(provider.local_frame()->origin().latitude_deg, kHome.latitude_deg);
  EXPECT_EQ(provider.counters().too_far, 1U);
}

TEST(StateProvider, KeepsItsFrameWhereItBegan) {
  StateProvider provider(StateConfig{});
  EXPECT_FALSE(provider.local_frame());
  provider.add(position(0.0, 0, 20));
  provider.add(position(0.1, 100, 20));
  ASSERT_TRUE(provider.local_frame());
  EXPECT_EQ(provider.local_frame()->origin().latitude_deg, kHome.latitude_deg);
  provider.restart();
  provider.add(position(0.0, 50, 20));
  EXPECT_EQ(provider.local_frame()->origin().latitude_deg, kHome.latitude_deg);
}

TEST(StateProvider, TellsWhatTheReceiverLastClaimedInASampleThatWasTakenIn) {
  StateProvider provider(StateConfig{});
  const auto claim_at = [&](double time_s, std::optional<double> sigma_m) {
    PositionSample sample = position(time_s, 0, 20);
    sample.sigma_horizontal_m = sigma_m;
    provider.add(sample);
  };
  for (int i = 0; i <= 10; ++i) provider.add(AttitudeSample{at_s(0.1 * i), {}});
  claim_at(0.0, 0.7);
  claim_at(0.2, 0.9);
  EXPECT_EQ(provider.at(at_s(0.1))->sigma_horizontal_m, 0.9);
  claim_at(0.2, 5.0);  // a duplicate
  EXPECT_EQ(provider.counters().duplicates, 1U);
  EXPECT_EQ(provider.at(at_s(0.1))->sigma_horizontal_m, 0.9);
  claim_at(0.4, std::nullopt);
  EXPECT_FALSE(provider.at(at_s(0.1))->sigma_horizontal_m);
}

/// Half way between two attitudes: the mean of each angle, or half of the one turn between them.
TEST(StateProvider, InterpolatesTheAttitudeAsConfigured) {
  const EulerAngles before{0.0, 0.0, 0.2}, after{1.0, 0.8, 1.6};
  for (const auto how : {AttitudeInterpolation::kCircular, AttitudeInterpolation::kSlerp}) {
    StateConfig config;
    config.attitude_interpolation = how;
    StateProvider provider(config);
    provider.add(position(0.0, 0, 20));
    provider.add(position(0.4, 0, 20));
    provider.add(AttitudeSample{at_s(0.0), before});
    provider.add(AttitudeSample{at_s(0.4), after});
    const Eigen::Quaterniond rotation = provider.at(at_s(0.2))->enu_from_body.rotation;
    Eigen::Quaterniond expected = ned_from_body({0.5, 0.4, 0.9});
    if (how == AttitudeInterpolation::kSlerp) {
      const Eigen::AngleAxisd turn(ned_from_body(before).conjugate() * ned_from_body(after));
      expected =
          ned_from_body(before) * Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * turn.angle(), turn.axis()));
    }
    EXPECT_LT((enu_from_ned() * expected).angularDistance(rotation), 1e-6);
    // The rate is that of the one turn, either way.
    const Eigen::AngleAxisd turn(ned_from_body(before).conjugate() * ned_from_body(after));
    EXPECT_LT((provider.at(at_s(0.2))->angular_velocity_in_body - turn.angle() / 0.4 * turn.axis()).norm(),
              1e-9);
  }
}

TEST(StateProvider, CountsWhatItDoesNotUse) {
  StateProvider provider(StateConfig{});
  provider.add(position(10.0, 0, 20));
  provider.add(AttitudeSample{at_s(10.0), {}});
  provider.add(AttitudeSample{at_s(10.0), {}});
  provider.add(AttitudeSample{at_s(9000.0), {}});  // far from the others' times
  EXPECT_EQ(provider.counters().duplicates, 1U);
  EXPECT_EQ(provider.counters().suspect_stamps, 1U);
  EXPECT_EQ(provider.counters().attitudes, 1U);
  EXPECT_EQ(provider.counters().positions, 1U);
}

/// The last 512 of each quantity are kept.
TEST(StateProvider, CountsWhatIsOlderThanAllThatIsKeptOfEitherQuantity) {
  StateProvider provider(StateConfig{});
  for (int i = 0; i < 512; ++i) {
    provider.add(position(1.0 + 0.008 * i, 0, 20));
    provider.add(AttitudeSample{at_s(1.0 + 0.008 * i), {}});
  }
  EXPECT_EQ(provider.counters().stale, 0U);
  provider.add(position(0.7, 0, 20));
  provider.add(position(0.8, 0, 20));
  provider.add(AttitudeSample{at_s(0.9), {}});
  EXPECT_EQ(provider.counters().stale, 3U);
}

/// North at 5 m/s and 20 m up; from then on the vehicle takes itself to be elsewhere.
struct Jump {
  double north_m = 0.0, up_m = 0.0, yaw_rad = 0.0;
};

void fly(StateProvider& provider, const Jump& jump, double jump_s, double until_s) {
  for (int i = 0; 0.1 * i <= until_s; ++i) {
    const double time_s = 0.1 * i;
    const Jump by = time_s >= jump_s ? jump : Jump{};
    provider.add(position(time_s, 5.0 * time_s + by.north_m, 20.0 + by.up_m));
    provider.add(AttitudeSample{at_s(time_s), {0.0, 0.0, wrap_to_pi(3.0 + by.yaw_rad)}});
  }
}

double yaw_of(const VehicleState& state) {
  return euler_angles(enu_from_ned() * state.enu_from_body.rotation).yaw_rad;
}

TEST(StateProvider, GoesOnAsBeforeWhereTheVehiclesOwnStateJumps) {
  for (const Jump& jump : {Jump{50.0, 0.0, 0.0}, Jump{-3.0, 0.0, 0.0}, Jump{0.0, 10.0, 0.0},
                           Jump{0.0, 0.0, 20.0 * kRadPerDeg}, Jump{8.0, -4.0, -0.5}}) {
    StateProvider provider(StateConfig{});
    fly(provider, jump, 3.95, 6.0);
    for (const double time_s : {3.85, 4.0, 4.05, 5.75}) {
      const auto state = provider.at(at_s(time_s));
      ASSERT_TRUE(state) << time_s;
      EXPECT_NEAR(state->enu_from_body.translation.y(), 5.0 * time_s, 0.03);
      EXPECT_NEAR(state->enu_from_body.translation.z(), 20.0, 1e-6);
      EXPECT_NEAR(wrap_to_pi(yaw_of(*state) - 3.0), 0.0, 1e-6);
      EXPECT_NEAR(state->velocity_in_enu.y(), 5.0, 0.01);
      EXPECT_EQ(state->steps.segment > 0, time_s >= 4.0);
    }
    EXPECT_EQ(provider.at(at_s(3.95)).error(), NoState::kInAGap);
    const StateSteps steps = provider.steps();
    EXPECT_LT((steps.size - Eigen::Vector4d(0.0, jump.north_m, jump.up_m, jump.yaw_rad)).norm(), 0.03);
    EXPECT_EQ(provider.counters().position_steps, jump.north_m != 0.0 ? 1U : 0U);
    EXPECT_EQ(provider.counters().height_steps, jump.up_m != 0.0 ? 1U : 0U);
    EXPECT_EQ(provider.counters().yaw_steps, jump.yaw_rad != 0.0 ? 1U : 0U);
  }
}

/// Half a turn at 360 deg/s, begun and ended at once, in a bank: the rates about the body's axes tell it.
TEST(StateProvider, TakesNoFastTurnForAStepOfTheYaw) {
  constexpr double kRoll_rad = 0.5, kPitch_rad = 0.2, kRate_radps = 2.0 * kPi;
  const auto count_steps = [&](bool tells_rates) {
    StateProvider provider(StateConfig{});
    for (int i = 0; i < 100; ++i) {
      const double time_s = 0.1 * i, into_s = std::clamp(time_s - 5.03, 0.0, 0.5);
      const double yaw_rate = into_s > 0.0 && into_s < 0.5 ? kRate_radps : 0.0;
      AttitudeSample sample{at_s(time_s), {kRoll_rad, kPitch_rad, wrap_to_pi(3.0 + kRate_radps * into_s)}};
      const Eigen::Vector3d about_down = Eigen::Vector3d(0.0, 0.0, yaw_rate);
      if (tells_rates) sample.rates_in_body_radps = ned_from_body(sample.angles).conjugate() * about_down;
      provider.add(position(time_s, 0.0, 20.0));
      provider.add(sample);
    }
    return provider.counters().yaw_steps;
  };
  EXPECT_GT(count_steps(false), 0U);
  EXPECT_EQ(count_steps(true), 0U);
}

TEST(StateProvider, WaitsForTheSampleAfterAJumpInsteadOfExtrapolatingIt) {
  StateProvider provider(StateConfig{});
  fly(provider, {50.0, 0.0, 0.0}, 3.95, 4.0);
  EXPECT_EQ(provider.at(at_s(4.004)).error(), NoState::kNotYet);
}

TEST(StateProvider, GoesOnFromTheStateThatItIsAnchoredIn) {
  StateProvider provider(StateConfig{});
  fly(provider, {50.0, 0.0, 0.0}, 3.95, 6.0);
  provider.anchor(at_s(5.0));
  EXPECT_NEAR(provider.at(at_s(5.5))->enu_from_body.translation.y(), 5.0 * 5.5 + 50.0, 0.03);
  EXPECT_NEAR(provider.at(at_s(3.5))->enu_from_body.translation.y(), 5.0 * 3.5 + 50.0, 0.03);
}

TEST(StateProvider, BelievesTheVehicleAnewAfterAReboot) {
  StateProvider provider(StateConfig{});
  fly(provider, {50.0, 10.0, 0.4}, 3.95, 6.0);
  provider.restart();
  fly(provider, {}, 0.0, 2.0);
  const auto state = provider.at(at_s(1.5));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->enu_from_body.translation.y(), 5.0 * 1.5, 0.03);
  EXPECT_NEAR(state->enu_from_body.translation.z(), 20.0, 1e-6);
  EXPECT_NEAR(wrap_to_pi(yaw_of(*state) - 3.0), 0.0, 1e-6);
}

TEST(StateProvider, TakesLateSamplesInBesideAJumpButNotInIt) {
  StateProvider provider(StateConfig{});
  fly(provider, {50.0, 0.0, 0.0}, 3.95, 6.0);
  provider.add(position(3.85, 5.0 * 3.85 + 0.02, 20.0));
  provider.add(position(3.96, 5.0 * 3.96 + 50.0, 20.0));
  provider.add(position(4.55, 5.0 * 4.55 + 50.02, 20.0));
  EXPECT_EQ(provider.counters().stale, 1U);
  EXPECT_NEAR(provider.at(at_s(3.85))->enu_from_body.translation.y(), 5.0 * 3.85 + 0.02, 0.005);
  EXPECT_NEAR(provider.at(at_s(4.55))->enu_from_body.translation.y(), 5.0 * 4.55 + 0.02, 0.03);
}

TEST(StateProvider, KeepsHeightsAboveTheFirstHome) {
  StateProvider provider(StateConfig{});
  for (int i = 0; i < 60; ++i) {
    PositionSample sample = position(0.1 * i, 0, i < 30 ? 20.0 : 23.0);
    sample.height_msl_m = 30.0;
    provider.add(sample);
    provider.add(AttitudeSample{at_s(0.1 * i), {}});
  }
  for (const double time_s : {2.5, 2.95, 4.0})
    EXPECT_NEAR(provider.at(at_s(time_s))->enu_from_body.translation.z(), 20.0, 1e-9);
  EXPECT_EQ(provider.counters().home_moves, 1U);
  EXPECT_EQ(provider.counters().height_steps, 0U);
  EXPECT_NEAR(provider.home().moved_up_m(), -3.0, 1e-9);
}

TEST(StateProvider, SaysHowFarInterpolationCanBeTrusted) {
  for (const double rate_hz : {1.0, 2.0, 10.0}) {
    StateProvider provider(StateConfig{});
    for (int i = 0; i < 20; ++i) {
      provider.add(position(i / rate_hz, 0, 20));
      provider.add(AttitudeSample{at_s(i / rate_hz), {}});
    }
    const auto halfway = provider.at(at_s(10.5 / rate_hz)), at_sample = provider.at(at_s(10.0 / rate_hz));
    ASSERT_TRUE(halfway && at_sample);
    EXPECT_NEAR(halfway->sigma_position_m, 1.0 / 8.0 / (rate_hz * rate_hz), 1e-9);
    EXPECT_NEAR(halfway->sigma_turn_rad, 8.0 * kRadPerDeg / 8.0 / (rate_hz * rate_hz), 1e-9);
    EXPECT_NEAR(seconds(halfway->telemetry_gap), 1.0 / rate_hz, 1e-9);
    EXPECT_EQ(at_sample->sigma_position_m, 0.0);
    EXPECT_EQ(at_sample->sigma_turn_rad, 0.0);
  }
}

TEST(StateProvider, NeedsNoNeighboursWhereBothSamplesAreOfExactlyThatTime) {
  StateProvider provider(StateConfig{});
  provider.add(position(7.0, 0, 20));
  provider.add(AttitudeSample{at_s(7.0), {}});
  const auto state = provider.at(at_s(7.0));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->velocity_in_enu.norm(), 0.0);
  EXPECT_EQ(state->angular_velocity_in_body.norm(), 0.0);
}

TEST(StateConfig, NamesEveryProblem) {
  StateConfig config;
  config.max_gap_s = -1;
  config.max_extrapolation_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(config.problems().size(), 2U);
  EXPECT_THROW(StateProvider{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
