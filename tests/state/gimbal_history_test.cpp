// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/gimbal_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc {
namespace {

VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}

Eigen::Quaterniond turned(double roll_deg, double pitch_deg, double yaw_deg) {
  return ned_from_body({roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg});
}

/// A vehicle at rest in the origin, told ten times a second for ten seconds, and its gimbal.
class Gimbals : public ::testing::Test {
 protected:
  /// The gimbal's samples of each second come at its end, in the order of their times or against it.
  static StateProvider provider_with(const std::vector<GimbalSample>& samples,
                                     const std::function<EulerAngles(double time_s)>& vehicle,
                                     const StateConfig& config = {}, bool is_reversed = false) {
    StateProvider provider(config);
    for (int i = 0; i <= 100; ++i) {
      PositionSample position;
      position.time = at_s(0.1 * i);
      position.position = {47.0, 8.0};
      position.height_above_home_m = 20.0;
      provider.add(position);
      provider.add(AttitudeSample{at_s(0.1 * i), vehicle(0.1 * i)});
      if (i % 10 != 0) continue;
      std::vector<GimbalSample> late;
      for (const GimbalSample& sample : samples) {
        if (sample.time > at_s(0.1 * i - 1.0) && sample.time <= at_s(0.1 * i)) late.push_back(sample);
      }
      if (is_reversed) std::reverse(late.begin(), late.end());
      for (const GimbalSample& sample : late) provider.add(sample);
    }
    return provider;
  }

  static std::vector<GimbalSample> samples_of(const std::function<Eigen::Quaterniond(double time_s)>& gimbal,
                                              GimbalYaw yaw) {
    std::vector<GimbalSample> samples;
    for (int i = 0; i <= 100; ++i) samples.push_back({at_s(0.1 * i + 0.02), gimbal(0.1 * i + 0.02), yaw});
    return samples;
  }

  static Expected<GimbalState, NoState> state_at(const StateProvider& provider, double time_s) {
    return provider.gimbal_at(*provider.at(at_s(time_s)));
  }

  static double angle_deg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.angularDistance(b) * kDegPerRad;
  }
};

EulerAngles shaking(double time_s) {
  return {0.2 * std::sin(2.0 * time_s), 0.15 * std::cos(3.0 * time_s), 0.4 * time_s};
}

TEST_F(Gimbals, WithAYawFromNorthAreAsTheySayWhateverTheVehicleDoes) {
  const Eigen::Quaterniond gimbal = turned(2.0, -60.0, 130.0);
  const StateProvider provider =
      provider_with(samples_of([&](double) { return gimbal; }, GimbalYaw::kFromNorth), shaking);
  for (const double time_s : {0.5, 3.33, 7.77}) {
    const auto state = state_at(provider, time_s);
    ASSERT_TRUE(state);
    EXPECT_LT(angle_deg(state->enu_from_gimbal, enu_from_ned() * gimbal), 1e-4);
    EXPECT_LT(state->turn_rate_in_enu.norm(), 1e-6);
  }
}

TEST_F(Gimbals, WithAYawFromTheNoseTurnWithItAloneAndNotWithRollAndPitch) {
  const Eigen::Quaterniond gimbal = turned(0.0, -45.0, 10.0);
  const StateProvider provider =
      provider_with(samples_of([&](double) { return gimbal; }, GimbalYaw::kFromNose), shaking);
  for (const double time_s : {0.5, 3.3, 7.7}) {  // at the vehicle's samples, where its yaw is exact
    const auto state = state_at(provider, time_s);
    ASSERT_TRUE(state);
    const double yaw_deg = 10.0 + 0.4 * time_s * kDegPerRad;
    EXPECT_LT(angle_deg(state->enu_from_gimbal, enu_from_ned() * turned(0.0, -45.0, yaw_deg)), 1e-4);
  }
}

/// The law holds for a gimbal that looks straight down, too, where angles of Euler turn over.
TEST_F(Gimbals, TurnAtTheRateAtWhichTheirPoseChanges) {
  const auto swinging = [](double time_s) {
    return turned(0.0, -70.0 - 20.0 * std::sin(time_s), 30.0 * std::cos(0.7 * time_s));
  };
  const auto turning = [](double time_s) { return EulerAngles{0.1, -0.1, 0.4 * time_s}; };
  for (const GimbalYaw yaw : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
    const StateProvider provider = provider_with(samples_of(swinging, yaw), turning);
    for (const double time_s : {1.07, 4.47, 8.57}) {
      constexpr double kStep_s = 1e-3;
      const Eigen::Quaterniond before = state_at(provider, time_s - kStep_s)->enu_from_gimbal,
                               after = state_at(provider, time_s + kStep_s)->enu_from_gimbal;
      const Eigen::AngleAxisd turn(after * before.conjugate());
      const Eigen::Vector3d rate = turn.angle() / (2.0 * kStep_s) * turn.axis();
      EXPECT_LT((state_at(provider, time_s)->turn_rate_in_enu - rate).norm(), 0.01 * rate.norm() + 1e-3);
    }
  }
}

TEST_F(Gimbals, AreInterpolatedAlikeInWhateverOrderTheirSamplesCome) {
  const auto swinging = [](double time_s) { return turned(1.0, -60.0 - 25.0 * std::sin(time_s), 5.0); };
  const std::vector<GimbalSample> samples = samples_of(swinging, GimbalYaw::kFromNorth);
  const StateProvider in_order = provider_with(samples, shaking);
  const StateProvider reversed = provider_with(samples, shaking, {}, true);
  for (const double time_s : {0.51, 5.0, 9.47}) {
    EXPECT_EQ(state_at(in_order, time_s)->enu_from_gimbal.coeffs(),
              state_at(reversed, time_s)->enu_from_gimbal.coeffs());
    EXPECT_LT(angle_deg(state_at(in_order, time_s)->enu_from_gimbal, enu_from_ned() * swinging(time_s)),
              0.05);
  }
}

TEST_F(Gimbals, SayWhyNothingIsKnownOfThem) {
  const auto vehicle = [](double) { return EulerAngles{}; };
  const auto sample = [](double time_s, GimbalYaw yaw = GimbalYaw::kFromNose) {
    return GimbalSample{at_s(time_s), turned(0, -90, 0), yaw};
  };
  EXPECT_EQ(state_at(provider_with({}, vehicle), 5.0).error(), NoState::kNoGimbal);
  const StateProvider some = provider_with({sample(2.0), sample(2.1), sample(6.0)}, vehicle);
  EXPECT_EQ(state_at(some, 1.0).error(), NoState::kTooOld);
  EXPECT_EQ(state_at(some, 4.0).error(), NoState::kInAGap);
  EXPECT_EQ(state_at(some, 7.0).error(), NoState::kNotYet);
  EXPECT_TRUE(state_at(some, 2.05));
  const StateProvider mixed = provider_with({sample(2.0), sample(2.2, GimbalYaw::kFromNorth)}, vehicle);
  EXPECT_EQ(state_at(mixed, 2.1).error(), NoState::kInAGap) << "of two origins";
}

TEST_F(Gimbals, ThatAreNoRotationsAreRefusedAndCounted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GimbalSample> samples{{at_s(1.0), Eigen::Quaterniond(0, 0, 0, 0)},
                                          {at_s(2.0), Eigen::Quaterniond(nan, 0, 0, 1)},
                                          {at_s(3.0), Eigen::Quaterniond(1.0, 0.5, 0.0, 0.0)},
                                          {at_s(4.0), Eigen::Quaterniond(1e300, 1e300, 0.0, 0.0)}};
  const StateProvider provider = provider_with(samples, shaking);
  EXPECT_EQ(provider.counters().invalid, 4U);
  EXPECT_EQ(provider.counters().gimbals, 0U);
}

/// What is known less well at longer gaps: as of the vehicle's own attitude.
TEST_F(Gimbals, AreLessCertainTheFartherTheirSamplesAreApart) {
  std::vector<GimbalSample> samples =
      samples_of([](double) { return turned(0, -90, 0); }, GimbalYaw::kFromNorth);
  samples.erase(samples.begin() + 50, samples.begin() + 59);  // a second, from 4.92 s
  const StateProvider provider = provider_with(samples, [](double) { return EulerAngles{}; });
  EXPECT_NEAR(state_at(provider, 5.42)->sigma_turn_rad, 8.0 * kRadPerDeg / 8.0, 1e-9);
  EXPECT_LT(state_at(provider, 3.97)->sigma_turn_rad, 0.011 * 8.0 * kRadPerDeg / 8.0);
  EXPECT_NEAR(seconds(state_at(provider, 5.42)->gap), 1.0, 1e-9);
}

/// Angles without noise while the vehicle shakes: a gimbal lags behind what it is told.
TEST_F(Gimbals, ThatTellWhatTheyWereToldAreUncertainAndUnknownInFastTurns) {
  const auto turning = [](double time_s) {
    EulerAngles angles = shaking(time_s);
    angles.yaw_rad = std::max(0.0, time_s - 5.0);
    return angles;
  };
  std::vector<GimbalSample> samples;
  for (int i = 0; i <= 200; ++i) samples.push_back({at_s(0.05 * i), turned(0, -90, 0), GimbalYaw::kFromNose});
  const StateProvider provider = provider_with(samples, turning);
  ASSERT_TRUE(provider.gimbal().is_set_point());
  EXPECT_NEAR(state_at(provider, 3.02)->sigma_turn_rad, 0.5 * kRadPerDeg, 0.05 * kRadPerDeg);
  EXPECT_EQ(state_at(provider, 7.02).error(), NoState::kInAGap) << "it follows a nose that turns by 57 deg/s";
}

TEST_F(Gimbals, AreReadAsTheConfigurationSays) {
  const Eigen::Quaterniond gimbal = turned(0, -50, 20);
  StateConfig config;
  const auto east = [](double) { return EulerAngles{0.0, 0.0, 90.0 * kRadPerDeg}; };
  for (const GimbalYaw told : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
    config.gimbal_yaw = GimbalYawReading::kFromNorth;
    const StateProvider north =
        provider_with({{at_s(1.0), gimbal, told}, {at_s(1.1), gimbal, told}}, east, config);
    EXPECT_LT(angle_deg(state_at(north, 1.05)->enu_from_gimbal, enu_from_ned() * turned(0, -50, 20)), 1e-4);
    config.gimbal_yaw = GimbalYawReading::kFromNose;
    const StateProvider nose =
        provider_with({{at_s(1.0), gimbal, told}, {at_s(1.1), gimbal, told}}, east, config);
    EXPECT_LT(angle_deg(state_at(nose, 1.05)->enu_from_gimbal, enu_from_ned() * turned(0, -50, 110)), 1e-4);
  }
}

/// North is where the vehicle's yaw has it, for the gimbal as for the vehicle: both go on as before the step.
TEST_F(Gimbals, GoOnWhereTheVehiclesYawSteps) {
  const auto stepping = [](double time_s) { return EulerAngles{0.0, 0.0, time_s < 5.05 ? 0.3 : 0.8}; };
  const auto gimbal = [](double time_s) {
    return turned(0.0, -60.0, time_s < 5.05 ? 0.0 : 0.5 * kDegPerRad);
  };
  const StateProvider provider = provider_with(samples_of(gimbal, GimbalYaw::kFromNorth), stepping);
  ASSERT_EQ(provider.counters().yaw_steps, 1U);
  EXPECT_LT(angle_deg(state_at(provider, 4.5)->enu_from_gimbal, state_at(provider, 5.5)->enu_from_gimbal),
            0.5);
}

TEST_F(Gimbals, AreForgottenWithTheClockThatTheyWereTimedBy) {
  StateProvider provider =
      provider_with(samples_of([](double) { return turned(0, -90, 0); }, GimbalYaw::kFromNose), shaking);
  ASSERT_TRUE(state_at(provider, 5.0));
  const VehicleState before = *provider.at(at_s(5.0));
  provider.on_clock_step();
  EXPECT_EQ(provider.gimbal_at(before).error(), NoState::kNoGimbal);
}

}  // namespace
}  // namespace geoloc
