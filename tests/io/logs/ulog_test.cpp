// SPDX-License-Identifier: Apache-2.0
#include "io/logs/ulog.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

#include "geoloc/io/logs/log_formats.hpp"
#include "log_bytes.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

const std::string kHeader = "ULog\x01\x12\x35\x01" + packed(std::uint64_t{0});

std::string message(char type, const std::string& body) {
  return packed(static_cast<std::uint16_t>(body.size())) + type + body;
}

std::string flags(std::uint8_t incompatible, std::uint64_t appended_offset = 0) {
  return message('B', std::string(8, '\0') + packed(incompatible) + std::string(7, '\0') +
                          packed(appended_offset, std::uint64_t{0}, std::uint64_t{0}));
}

const std::string kDefinitions =
    message('F', "place:double lat;double lon;") +
    message('F', "vehicle_global_position:uint64_t timestamp;double lat;double lon;float alt;") +
    message('A', packed(std::uint8_t{0}, std::uint16_t{7}) + "vehicle_global_position");

std::string placed(std::uint64_t time_us) {
  return message('D', packed(std::uint16_t{7}, time_us, 47.5, 8.5, 488.5F));
}

TEST(Ulog, SamplesAreReadAsTheirFormatsTell) {
  const FlightLog log = parse_ulog(kHeader + flags(0) + kDefinitions + placed(1'500'000));
  ASSERT_EQ(log.positions.size(), 1U);
  EXPECT_EQ(log.positions[0].time, VehicleTime{1500ms});
  EXPECT_EQ(log.positions[0].position.latitude_deg, 47.5);
  EXPECT_EQ(log.positions[0].heights.msl_m, 488.5);
  EXPECT_EQ(log.skipped_bytes, 0U);
}

TEST(Ulog, FormatsAreNested) {
  const auto layout = ulog_layout(
      {{"outer", "uint64_t timestamp;inner[2] places;bool valid"}, {"inner", "double lat;float[3] q"}},
      "outer");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->fields.at("places[1].q[2]").offset, 8U + 20U + 8U + 8U);
  EXPECT_EQ(layout->fields.at("valid").offset, 8U + 40U);
}

TEST(Ulog, FormatsThatHoldThemselvesOrMoreThanAMessageAreNone) {
  EXPECT_FALSE(ulog_layout({{"a", "a[2] again"}}, "a"));
  EXPECT_FALSE(ulog_layout({{"a", "double[9000] x"}}, "a"));
  EXPECT_FALSE(ulog_layout({{"a", "b x"}}, "a"));
  EXPECT_FALSE(ulog_layout({{"a", "b[60000] x"}, {"b", "c[60000] x"}, {"c", ""}}, "a"));
}

TEST(Ulog, DamageCostsTheMessagesThatItHits) {
  const std::string damage = "\xff\xff\xff\xff\xff";
  const FlightLog log = parse_ulog(kHeader + kDefinitions + placed(1'000) + damage + placed(2'000) +
                                   placed(3'000) + placed(4'000) + placed(5'000).substr(0, 10));
  ASSERT_EQ(log.positions.size(), 4U);
  EXPECT_EQ(log.positions[3].time, VehicleTime{4ms});
  EXPECT_EQ(log.skipped_bytes, damage.size() + 10U);
}

TEST(Ulog, WhatWasAppendedIsReadThoughTheMessageBeforeItIsCut) {
  const std::string begin =
      kHeader + flags(1, 0) + kDefinitions + placed(1'000) + placed(2'000).substr(0, 12);
  const std::string whole = kHeader + flags(1, begin.size()) + begin.substr(kHeader.size() + flags(0).size());
  const FlightLog log = parse_ulog(whole + placed(3'000));
  ASSERT_EQ(log.positions.size(), 2U);
  EXPECT_EQ(log.positions[1].time, VehicleTime{3ms});
  EXPECT_EQ(log.skipped_bytes, 12U);
}

TEST(Ulog, LogsOfALaterKindAreRefused) {
  EXPECT_THROW(parse_ulog(kHeader + flags(2) + kDefinitions + placed(1'000)), std::runtime_error);
  EXPECT_THROW(parse_ulog("something else"), std::runtime_error);
}

std::string subscribed(std::uint16_t number, const std::string& topic, const std::string& fields) {
  return message('F', topic + ":" + fields) + message('A', packed(std::uint8_t{0}, number) + topic);
}

TEST(Ulog, PicturesCountOnceWhereTheyWereTriggeredAndTaken) {
  const std::string fields = "uint64_t timestamp;";
  const auto event = [](int number, std::uint64_t time_us) {
    return message('D', packed(static_cast<std::uint16_t>(number), time_us));
  };
  const std::string begin = kHeader + flags(0) + kDefinitions + subscribed(8, "camera_trigger", fields) +
                            subscribed(9, "camera_capture", fields) + placed(1) + event(8, 2'000'000);
  const FlightLog triggered = parse_ulog(begin + event(8, 4'000'000));
  EXPECT_EQ(triggered.camera_events.size(), 2U);
  const FlightLog taken = parse_ulog(begin + event(9, 2'100'000) + event(8, 4'000'000) + event(9, 4'100'000));
  ASSERT_EQ(taken.camera_events.size(), 2U);
  EXPECT_EQ(taken.camera_events[0].time, VehicleTime{2100ms});
}

TEST(Ulog, GimbalsTellWhatTheirYawCountsFromAndWhetherTheyHoldIt) {
  constexpr std::uint16_t kYawLock = 16, kVehicleFrame = 32;
  const auto gimbal = [](std::uint16_t device_flags) {
    return message('D', packed(std::uint16_t{8}, std::uint64_t{1}, 1.0F, 0.0F, 0.0F, 0.0F, device_flags));
  };
  const FlightLog log = parse_ulog(
      kHeader + flags(0) + kDefinitions +
      subscribed(8, "gimbal_device_attitude_status", "uint64_t timestamp;float[4] q;uint16_t device_flags;") +
      placed(1) + gimbal(kYawLock) + gimbal(kVehicleFrame));
  ASSERT_EQ(log.gimbal.size(), 2U);
  EXPECT_EQ(log.gimbal[0].yaw, GimbalYaw::kFromNorth);
  EXPECT_EQ(log.gimbal[0].holds_direction, true);
  EXPECT_EQ(log.gimbal[1].yaw, GimbalYaw::kFromNose);
  EXPECT_EQ(log.gimbal[1].holds_direction, false);
}

TEST(Ulog, LocalPositionsHangOnTheirReference) {
  const std::string log_bytes =
      kHeader +
      message('F',
              "vehicle_local_position:uint64_t timestamp;double ref_lat;double ref_lon;float ref_alt;float x;"
              "float y;float z;") +
      message('A', packed(std::uint8_t{0}, std::uint16_t{1}) + "vehicle_local_position") +
      message('D', packed(std::uint16_t{1}, std::uint64_t{1}, 47.5, 8.5, 488.0F, 111.19493F, 0.0F, -10.0F));
  const FlightLog log = parse_ulog(log_bytes);
  ASSERT_EQ(log.positions.size(), 1U);
  EXPECT_NEAR(log.positions[0].position.latitude_deg, 47.501,
              1e-8);  // a thousandth of a degree of PX4's sphere
  EXPECT_NEAR(log.positions[0].position.longitude_deg, 8.5, 1e-9);
  EXPECT_EQ(log.positions[0].heights.msl_m, 498.0);
}

}  // namespace
}  // namespace geoloc::io
