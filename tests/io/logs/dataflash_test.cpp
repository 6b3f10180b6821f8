// SPDX-License-Identifier: Apache-2.0
#include "io/logs/dataflash.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"
#include "log_bytes.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

std::string format(std::uint8_t type, std::uint8_t size, const char* name, const char* types,
                   const char* columns) {
  return "\xA3\x95\x80" + packed(type, size) + padded(name, 4) + padded(types, 16) + padded(columns, 64);
}

template <typename... Numbers>
std::string record(std::uint8_t type, Numbers... numbers) {
  return "\xA3\x95" + packed(type, numbers...);
}

const std::string kPositionFormat =
    format(130, 3 + 8 + 8 + 8, "POS", "QLLff", "TimeUS,Lat,Lng,Alt,RelHomeAlt");
const std::string kAttitudeFormat = format(131, 3 + 8 + 6, "ATT", "QccC", "TimeUS,Roll,Pitch,Yaw");

std::string position(std::uint64_t time_us, std::int32_t latitude = 473977419) {
  return record(130, time_us, latitude, std::int32_t{85455941}, 488.5F, 12.5F);
}

std::string attitude(std::uint64_t time_us) {
  return record(131, time_us, std::int16_t{-150}, std::int16_t{250}, std::uint16_t{27000});
}

TEST(Dataflash, RecordsAreReadAsTheirFormatsTell) {
  const FlightLog log =
      parse_dataflash(kPositionFormat + kAttitudeFormat + position(1'500'000) + attitude(1'600'000));
  ASSERT_EQ(log.positions.size(), 1U);
  EXPECT_EQ(log.positions[0].time, VehicleTime{1500ms});
  EXPECT_EQ(log.positions[0].position.latitude_deg, 47.3977419);
  EXPECT_EQ(log.positions[0].position.longitude_deg, 8.5455941);
  EXPECT_EQ(log.positions[0].heights.msl_m, 488.5);
  EXPECT_EQ(log.positions[0].heights.above_home_m, 12.5);
  ASSERT_EQ(log.attitudes.size(), 1U);
  EXPECT_DOUBLE_EQ(log.attitudes[0].angles.roll_rad, -1.5 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(log.attitudes[0].angles.pitch_rad, 2.5 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(log.attitudes[0].angles.yaw_rad, -90.0 * kRadPerDeg);
  EXPECT_EQ(log.skipped_bytes, 0U);
}

TEST(Dataflash, DamageCostsTheRecordsThatItHits) {
  const std::string damage = "\xA3\x95\x82 something else \xA3";
  const FlightLog log = parse_dataflash(kPositionFormat + position(1'000) + damage + position(2'000) +
                                        position(3'000).substr(0, 20));
  ASSERT_EQ(log.positions.size(), 2U);
  EXPECT_EQ(log.positions[1].time, VehicleTime{2ms});
  EXPECT_EQ(log.skipped_bytes, damage.size() + 20U);
}

TEST(Dataflash, FormatsThatContradictThemselvesAreNotUsed) {
  EXPECT_THROW(
      parse_dataflash(format(130, 40, "POS", "QLLff", "TimeUS,Lat,Lng,Alt,RelHomeAlt") + position(1'000)),
      std::runtime_error);
  EXPECT_THROW(
      parse_dataflash(format(130, 27, "POS", "QLL?f", "TimeUS,Lat,Lng,Alt,RelHomeAlt") + position(1'000)),
      std::runtime_error);
}

TEST(Dataflash, PositionsOfAVehicleThatKnowsNoneAreNone) {
  const std::string nowhere = record(130, std::uint64_t{500}, std::int32_t{0}, std::int32_t{0}, 0.0F, 0.0F);
  EXPECT_EQ(parse_dataflash(kPositionFormat + nowhere + position(1'000)).positions.size(), 1U);
  EXPECT_THROW(parse_dataflash(kPositionFormat + nowhere), std::runtime_error);
}

TEST(Dataflash, OldLogsCountMilliseconds) {
  const FlightLog log = parse_dataflash(
      format(130, 3 + 4 + 8 + 8, "POS", "ILLff", "TimeMS,Lat,Lng,Alt,RelAlt") +
      record(130, std::uint32_t{1500}, std::int32_t{473977419}, std::int32_t{85455941}, 488.5F, 12.5F));
  EXPECT_EQ(log.positions.at(0).time, VehicleTime{1500ms});
  EXPECT_EQ(log.positions.at(0).heights.above_home_m, 12.5);
}

TEST(Dataflash, GpsTimeIsUtc) {
  const std::string fixes =
      format(132, 3 + 8 + 2 + 4 + 2 + 8, "GPS", "QBBIHLL", "TimeUS,I,Status,GMS,GWk,Lat,Lng") +
      record(132, std::uint64_t{110'389'160}, std::uint8_t{0}, std::uint8_t{6}, std::uint32_t{385'016'200},
             std::uint16_t{2446}, std::int32_t{473977420}, std::int32_t{85455940});
  const FlightLog log = parse_dataflash(fixes + kPositionFormat + position(1'000));
  ASSERT_EQ(log.utc.size(), 1U);  // 2026-11-26 10:56:38.2
  EXPECT_EQ(log.utc[0].utc.time_since_epoch(), Duration{1'795'690'598'200ms});
}

TEST(Dataflash, PicturesCountOnceWhereTheCameraTellsOfThem) {
  const std::string formats = kPositionFormat + format(133, 3 + 8, "TRIG", "Q", "TimeUS") +
                              format(134, 3 + 8, "CAM", "Q", "TimeUS") +
                              format(135, 3 + 8 + 2, "MAVC", "QH", "TimeUS,Cmd");
  const FlightLog log = parse_dataflash(
      formats + position(1'000) + record(133, std::uint64_t{2'000}) + record(134, std::uint64_t{3'000}) +
      record(133, std::uint64_t{4'000}) + record(135, std::uint64_t{5'000}, std::uint16_t{2500}) +
      record(135, std::uint64_t{6'000}, std::uint16_t{400}));
  ASSERT_EQ(log.camera_events.size(), 2U);
  EXPECT_EQ(log.camera_events[0].time, VehicleTime{3ms});
  EXPECT_EQ(log.camera_events[0].kind, CameraEventKind::kExposure);
  EXPECT_EQ(log.camera_events[1].kind, CameraEventKind::kVideoStart);
}

}  // namespace
}  // namespace geoloc::io
