// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

FlightLog subtitle(const std::string& text) {
  return parse_srt("1\n00:00:01,040 --> 00:00:01,080\n" + text + "\n\n");
}

TEST(Subtitles, OfNewModelsTellPlaceHeightsAndGimbal) {
  const FlightLog log = subtitle(
      "<font size=\"28\">FrameCnt: 1, DiffTime: 41ms, FrameId: 4787\n2026-05-27 13:10:00.015\n[iso: 200] "
      "[focal_len: 28.00] [dzoom_ratio: 1.00], [latitude: 53.365080] [longitude: -6.460739] [rel_alt: 5.400 "
      "abs_alt: -124.744] [gb_yaw: -162.8 gb_pitch: -30.5 gb_roll: 0.1] [pp_target:0.9, -0.0]</font>");
  ASSERT_EQ(log.positions.size(), 1U);
  EXPECT_EQ(log.positions[0].time, VehicleTime{1040ms});
  EXPECT_EQ(log.positions[0].position.latitude_deg, 53.365080);
  EXPECT_EQ(log.positions[0].position.longitude_deg, -6.460739);
  EXPECT_EQ(log.positions[0].heights.above_home_m, 5.4);
  EXPECT_EQ(log.positions[0].heights.msl_m, -124.744);
  ASSERT_EQ(log.gimbal.size(), 1U);
  EXPECT_DOUBLE_EQ(log.gimbal[0].angles.yaw_rad, -162.8 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(log.gimbal[0].angles.pitch_rad, -30.5 * kRadPerDeg);
  ASSERT_EQ(log.utc.size(), 1U);
  EXPECT_EQ(log.utc[0].utc.time_since_epoch(), Duration{1'779'887'400'015ms});
  ASSERT_EQ(log.focal_lengths.size(), 1U);
  EXPECT_EQ(log.focal_lengths[0].equivalent_mm, 28.0);
}

TEST(Subtitles, OfOldModelsTellLongitudeFirst) {
  const FlightLog log =
      subtitle("HOME(9.0251,-20.2532) 2017.08.05 14:11:51\nGPS(9.0251,-20.2533,16) BAROMETER:1.9\nISO:100");
  EXPECT_EQ(log.positions.at(0).position.longitude_deg, 9.0251);
  EXPECT_EQ(log.positions.at(0).heights.above_home_m, 1.9);
  ASSERT_EQ(log.assumptions.size(), 1U);
  EXPECT_NE(log.assumptions[0].find("longitude, latitude"), std::string::npos);
}

TEST(Subtitles, WhoseOrderIsPlainByTheNumbersAssumeNothing) {
  for (const char* text :
       {"GPS(116.391305,39.906217,69.8) BAROMETER:91.2", "GPS(39.906217,116.391305,69.8) BAROMETER:91.2"}) {
    const FlightLog log = subtitle(text);
    EXPECT_EQ(log.positions.at(0).position.latitude_deg, 39.906217);
    EXPECT_TRUE(log.assumptions.empty());
  }
}

TEST(Subtitles, InOneLineTellTheHeightAsH) {
  const FlightLog log =
      subtitle("F/2.8, SS 206.14, ISO 150, EV 0, GPS (-122.1699, 37.4250, 15), D 2.1m, H 6.00m, H.S 0.0m/s");
  EXPECT_EQ(log.positions.at(0).position.latitude_deg, 37.4250);
  EXPECT_EQ(log.positions.at(0).heights.above_home_m, 6.0);
}

TEST(Subtitles, OfMavic2AreMisspelt) {
  const FlightLog log = subtitle(
      "2018-10-12 11:04:56,123,456\n[focal_len : 240] [latitude : 0.608553] [longtitude : -1.963763] "
      "[altitude: 1429.7]");
  EXPECT_EQ(log.positions.at(0).position.longitude_deg, -1.963763);
  EXPECT_EQ(log.positions.at(0).heights.msl_m, 1429.7);
  ASSERT_EQ(log.focal_lengths.size(), 1U);
  EXPECT_EQ(log.focal_lengths[0].equivalent_mm, 24.0);
  EXPECT_EQ(log.utc.at(0).utc.time_since_epoch() % 1s, 123'456us);
}

TEST(Subtitles, TellEachChangeOfTheZoom) {
  std::string text;
  for (int i = 0; i < 6; ++i) {
    const int focal_mm = i < 2 ? 24 : i < 4 ? 70 : 24;
    text += std::to_string(i + 1) + "\n00:00:0" + std::to_string(i) + ",000 --> 00:00:0" + std::to_string(i) +
            ",900\n[focal_len: " + std::to_string(focal_mm) +
            ".00] [dzoom_ratio: " + (i == 5 ? "2.00" : "1.00") +
            "], [latitude: 53.3] [longitude: -6.4] [rel_alt: 5.4 abs_alt: 30.0]\n\n";
  }
  const FlightLog log = parse_srt(text);
  ASSERT_EQ(log.focal_lengths.size(), 4U);
  const double expected_mm[] = {24.0, 70.0, 24.0, 48.0};
  const std::chrono::seconds expected_at[] = {0s, 2s, 4s, 5s};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(log.focal_lengths[i].equivalent_mm, expected_mm[i]);
    EXPECT_EQ(log.focal_lengths[i].time, VehicleTime{expected_at[i]});
  }
  EXPECT_TRUE(log.assumptions.empty());
}

TEST(Subtitles, OfAFilmAreNoLog) {
  EXPECT_THROW(subtitle("Good evening."), std::runtime_error);
}

}  // namespace
}  // namespace geoloc::io
