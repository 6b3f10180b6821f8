// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/state_messages.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <variant>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

Message read_back(const OutgoingFrame& frame) {
  FrameParser parser;
  parser.append(frame.bytes.data(), frame.size);
  const auto found = parser.next();
  return found ? decode(*found) : Message{RefusedValues{}};
}

PositionSample some_position() {
  PositionSample sample;
  sample.time = VehicleTime{1234ms};
  sample.position = {-22.9061234, 179.9999999};
  sample.height_above_home_m = -3.25;
  sample.height_msl_m = 512.999;
  sample.velocity_in_enu = Eigen::Vector3d(1.25, -7.5, 0.5);
  return sample;
}

TEST(StateMessages, AreReadBackAsTheyWereTold) {
  StateWriter writer;
  EXPECT_TRUE(std::get<Heartbeat>(read_back(writer.heartbeat())).is_from_autopilot());
  const AttitudeSample attitude{VehicleTime{1234ms}, {0.1, -0.2, 3.0}, Eigen::Vector3d(0.5, 0.25, -0.125)};
  const auto attitude_again = std::get<AttitudeMessage>(read_back(writer.attitude(attitude))).sample;
  EXPECT_EQ(attitude_again.time, attitude.time);
  EXPECT_FLOAT_EQ(static_cast<float>(attitude_again.angles.yaw_rad), 3.0F);
  EXPECT_EQ(attitude_again.rates_in_body_radps, attitude.rates_in_body_radps);
  const PositionSample told = some_position();
  const auto position = std::get<PositionSample>(read_back(writer.position(told)));
  EXPECT_EQ(position.time, told.time);
  EXPECT_DOUBLE_EQ(position.position.latitude_deg, told.position.latitude_deg);
  EXPECT_DOUBLE_EQ(position.position.longitude_deg, told.position.longitude_deg);
  EXPECT_DOUBLE_EQ(position.height_above_home_m, told.height_above_home_m);
  EXPECT_DOUBLE_EQ(*position.height_msl_m, *told.height_msl_m);
  EXPECT_EQ(position.velocity_in_enu, told.velocity_in_enu);
  const auto gnss = std::get<GnssStatus>(read_back(writer.gnss(told, {6, 0.05, 0.02})));
  EXPECT_EQ(gnss.fix_type, 6);
  EXPECT_DOUBLE_EQ(gnss.sigma_horizontal_m.value(), 0.05);
}

TEST(StateMessages, GimbalsAreReadBackAsTheyWereTold) {
  StateWriter writer;
  for (const GimbalYaw yaw : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth}) {
    for (const std::optional<bool> holds :
         {std::optional<bool>{}, std::optional(false), std::optional(true)}) {
      for (const double pitch_rad : {0.0, -0.7, -1.5707}) {
        const GimbalSample told{VehicleTime{1234ms}, ned_from_body({0.02, pitch_rad, 3.0}), yaw, holds};
        const auto again = std::get<GimbalMessage>(read_back(writer.gimbal(told))).sample;
        EXPECT_EQ(again.time, told.time);
        EXPECT_EQ(again.yaw, yaw);
        EXPECT_EQ(again.holds_direction, holds);
        EXPECT_LT(again.level_from_gimbal.angularDistance(told.level_from_gimbal), 1e-6);
      }
    }
  }
}

TEST(StateMessages, WhatIsNotToldIsNotInvented) {
  StateWriter writer;
  const auto attitude = std::get<AttitudeMessage>(read_back(writer.attitude({VehicleTime{1ms}, {}}))).sample;
  EXPECT_FALSE(attitude.rates_in_body_radps->allFinite());
  EXPECT_FALSE(std::get<GnssStatus>(read_back(writer.gnss(some_position(), {}))).sigma_horizontal_m);
}

TEST(StateMessages, BeyondWhatAMessageHoldsStayAtItsEnds) {
  StateWriter writer;
  PositionSample fast = some_position();
  fast.velocity_in_enu = Eigen::Vector3d(1e6, -1e6, 0.0);
  const auto position = std::get<PositionSample>(read_back(writer.position(fast)));
  EXPECT_DOUBLE_EQ(position.velocity_in_enu->x(), 327.67);
  EXPECT_DOUBLE_EQ(position.velocity_in_enu->y(), -327.68);
}

}  // namespace
}  // namespace geoloc::io
