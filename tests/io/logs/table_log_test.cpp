// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

std::string refusal_of(const std::string& text) {
  try {
    parse_log_table(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(LogTable, ColumnsMayComeInAnyOrderAndCellsMayBeEmpty) {
  const FlightLog log = parse_log_table(
      "lon,lat,note,time_s,height_above_home_m,roll_deg,pitch_deg,yaw_deg\r\n8.5,47.5,x,1.5,20,,,\r\n,,,1.6,,"
      "1,2,270\r\n");
  ASSERT_EQ(log.positions.size(), 1U);
  EXPECT_EQ(log.positions[0].time, VehicleTime{1500ms});
  EXPECT_EQ(log.positions[0].position.latitude_deg, 47.5);
  EXPECT_EQ(log.positions[0].heights.above_home_m, 20.0);
  EXPECT_FALSE(log.positions[0].heights.msl_m);
  ASSERT_EQ(log.attitudes.size(), 1U);
  EXPECT_DOUBLE_EQ(log.attitudes[0].angles.yaw_rad, -90.0 * kRadPerDeg);
}

TEST(LogTable, UtcIsTheClockWhereNoOtherIsTold) {
  const FlightLog log = parse_log_table("utc,lat,lon\n2026-05-27T13:10:00.015Z,47.5,8.5\n");
  EXPECT_EQ(log.positions.at(0).time.time_since_epoch(), Duration{1'779'887'400'015ms});
  EXPECT_EQ(log.utc.at(0).utc.time_since_epoch(), Duration{1'779'887'400'015ms});
}

TEST(LogTable, WhatIsWrongIsNamedByLineAndColumn) {
  EXPECT_EQ(refusal_of("time_s,lat\n"), "line 1: there is no column `lon`");
  EXPECT_EQ(refusal_of("lat,lon\n"), "line 1: there is no column `time_s` or `utc`");
  EXPECT_EQ(refusal_of("time_s,lat,lon\n1,47.5,8.5\n2,47.x,8.5\n"),
            "line 3: column `lat`: is no number: `47.x`");
  EXPECT_EQ(refusal_of("time_s,lat,lon\n1,97.5,8.5\n"), "line 2: column `lat`: 97.5 is out of range");
  EXPECT_EQ(refusal_of("time_s,lat,lon\n,47.5,8.5\n"), "line 2: column `time_s`: is empty");
  EXPECT_EQ(refusal_of("utc,lat,lon\n13:10,47.5,8.5\n"),
            "line 2: column `utc`: expected a time such as 2026-05-27T13:10:00.015Z, found `13:10`");
  EXPECT_EQ(refusal_of("time_s,lat,lon\n"), "holds no position: the vehicle never knew where it was");
}

}  // namespace
}  // namespace geoloc::io
