// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/video_telemetry.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "fuzz/hostile_video_telemetry.hpp"
#include "support/source_tree.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

std::string text_of(const std::string& name) {
  std::ifstream file(source_tree() / "tests/fuzz/seeds/video_telemetry" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A record with another text in the place of one.
std::string with(const std::string& part, const std::string& other) {
  std::string text = text_of("whole.json");
  const auto at = text.find(part);
  if (at == std::string::npos) throw std::invalid_argument(part);
  return text.replace(at, part.size(), other);
}

TEST(VideoTelemetry, EveryFieldIsReadInItsUnitAndFrame) {
  const auto told = parse_video_telemetry(text_of("whole.json"));
  ASSERT_TRUE(told);
  EXPECT_EQ(told->made_at.time_since_epoch(), 1'764'489'600'123'456us);
  ASSERT_TRUE(told->position && told->velocity && told->vehicle && told->gimbal);
  EXPECT_NEAR(told->position->position.latitude_deg, -35.3632610, 1e-9);
  EXPECT_NEAR(told->position->position.longitude_deg, 149.1652300, 1e-9);
  EXPECT_EQ(told->position->height_msl_m, 650.25);
  EXPECT_EQ(told->position->height_above_home_m, 60.5);
  EXPECT_EQ(told->position->age, 80ms);
  EXPECT_TRUE(told->velocity->velocity_in_enu.isApprox(Eigen::Vector3d(-3.5, 1.25, -0.125)));
  EXPECT_EQ(told->vehicle->angles.roll_rad, 0.1);
  EXPECT_EQ(told->vehicle->angles.pitch_rad, -0.2);
  EXPECT_EQ(told->vehicle->angles.yaw_rad, 1.570796);
  EXPECT_EQ(told->vehicle->age, 12ms);
  EXPECT_EQ(told->gimbal->angles.roll_rad, 0.001);
  EXPECT_EQ(told->gimbal->angles.pitch_rad, -1.570796);
  EXPECT_EQ(told->gimbal->angles.yaw_rad, -0.1);
  EXPECT_EQ(told->gimbal->age, 45ms);
  EXPECT_EQ(told->zoom, 2.5);
  EXPECT_EQ(told->horizontal_fov_deg, 42.2);
  EXPECT_EQ(told->refused_values, 0);
}

TEST(VideoTelemetry, WhatIsNullOrMissingIsUnknown) {
  for (const std::string& text :
       {text_of("unknown.json"), std::string(R"({"schema": "apcg.telemetry.v1", "utc_us": 5})")}) {
    const auto told = parse_video_telemetry(text);
    ASSERT_TRUE(told) << text;
    EXPECT_FALSE(told->position || told->velocity || told->vehicle || told->gimbal || told->zoom ||
                 told->horizontal_fov_deg);
    EXPECT_EQ(told->refused_values, 0);
  }
}

TEST(VideoTelemetry, ItsTextIsReadBack) {
  const auto told = parse_video_telemetry(text_of("whole.json"));
  ASSERT_TRUE(told);
  EXPECT_EQ(to_json(*parse_video_telemetry(to_json(*told))), to_json(*told));
}

TEST(VideoTelemetry, ValuesThatCannotBeAreUnknownAndCounted) {
  for (const auto& [part, other] : std::initializer_list<std::pair<const char*, const char*>>{
           {"-353632610", "-900000001"},
           {"1491652300", "1800000001"},
           {"650.250", "1e30"},
           {"\"alt_relative_m\":60.500,", ""},
           {"\"lat_e7\":-353632610", "\"lat_e7\":\"-353632610\""},
           {"\"age_ms\":80},\"velocity\"", "\"age_ms\":10001},\"velocity\""},
           {"\"age_ms\":80},\"velocity\"", "\"age_ms\":-1},\"velocity\""},
           {",\"age_ms\":80},\"velocity\"", "},\"velocity\""},
           {"1.250", "321"},
           {"\"pitch_rad\":-0.200000", "\"pitch_rad\":1.6"},
           {"\"roll_rad\":0.100000", "\"roll_rad\":[0.1]"},
           {"-1.570796", "7"},
           {"2.500", "-1"},
           {"42.2000", "180"},
           {"42.2000", "true"}}) {
    const auto told = parse_video_telemetry(with(part, other));
    ASSERT_TRUE(told) << other;
    EXPECT_EQ(told->refused_values, 1) << other;
    const int known = told->position.has_value() + told->velocity.has_value() + told->vehicle.has_value() +
                      told->gimbal.has_value() + told->zoom.has_value() +
                      told->horizontal_fov_deg.has_value();
    EXPECT_EQ(known, 5) << other;
  }
}

TEST(VideoTelemetry, WhatIsNoRecordIsRefused) {
  const std::string whole = text_of("whole.json");
  const std::string deep(8000, '[');
  for (const std::string& text :
       {std::string(), std::string("null"), std::string("[]"), deep,
        std::string(kLongestTelemetry, ' ') + whole, with("apcg.telemetry.v1", "apcg.telemetry.v2"),
        with("\"apcg.telemetry.v1\"", "1"), with("1764489600123456", "-1"), with("1764489600123456", "1e15"),
        with("1764489600123456", "18446744073709551615"), with("1764489600123456", "null"),
        with("\"utc_us\"", "\"utc\""), with("650.250", "NaN"), with("650.250", "1e999"),
        with("650.250", "\xff"), whole.substr(0, whole.size() / 2), R"({"a":)" + deep})
    EXPECT_FALSE(parse_video_telemetry(text)) << text.substr(0, 80);
}

TEST(VideoTelemetry, ZerosBehindARecordDoNoHarm) {
  EXPECT_TRUE(parse_video_telemetry(text_of("unknown.json") + std::string(3, '\0')));
}

TEST(VideoTelemetry, DamagedRecordsAreRefusedOrTellWhatCanBe) {
  const std::string whole = text_of("whole.json");
  int records = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    hostile::read_any_telemetry(whole.substr(0, at));
    for (const char byte : {'\0', '9', '-', 'e', '"', '{', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = byte;
      records += hostile::read_any_telemetry(damaged) ? 1 : 0;
    }
  }
  EXPECT_GT(records, 100);
}

}  // namespace
}  // namespace geoloc::io
