// SPDX-License-Identifier: Apache-2.0
#include "truth_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

const std::string kHeader = "time_boot_s,lat,lon,alt_amsl,roll,pitch,yaw,vn,ve,vd\n";
const std::string kTwoRows = "1.0,-22.9,-43.1,10.5,0.1,-0.2,3.0,0,0,0\n1.5,-22.8,-43.2,11,0,0,-3.0,0,0,0\n";

std::string reason_for(const std::string& csv) {
  try {
    parse_truth_csv(csv, "flight.csv");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), {}};
}

TEST(TruthFile, ReadsTheColumnsItNeeds) {
  const auto states = parse_truth_csv(kHeader + kTwoRows, "flight.csv");
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].time, VehicleTime{std::chrono::seconds{1}});
  EXPECT_EQ(states[1].position.latitude_deg, -22.8);
  EXPECT_EQ(states[1].position.longitude_deg, -43.2);
  EXPECT_EQ(states[0].height_msl_m, 10.5);
  EXPECT_EQ(states[0].attitude.roll_rad, 0.1);
  EXPECT_EQ(states[0].attitude.pitch_rad, -0.2);
  EXPECT_EQ(states[1].attitude.yaw_rad, -3.0);
}

TEST(TruthFile, TakesDosLineEnds) {
  std::string csv = kHeader + kTwoRows;
  for (std::size_t at = 0; (at = csv.find('\n', at)) != std::string::npos; at += 2) csv.insert(at, 1, '\r');
  EXPECT_EQ(parse_truth_csv(csv, "flight.csv").size(), 2U);
}

TEST(TruthFile, NamesTheLineAndTheFault) {
  EXPECT_NE(reason_for("").find("line 1: the columns must begin with"), std::string::npos);
  EXPECT_NE(reason_for("time_boot_s,lat,lon,alt_amsl,roll,pitch,yawn\n" + kTwoRows).find("line 1"),
            std::string::npos);
  const std::vector<std::pair<std::string, std::string>> bad_rows = {
      {"2.0,-22.9,-43.1,10.5,0.1,-0.2\n", "line 4: too few columns"},
      {"2.0,-22.9,-43.1,nan,0.1,-0.2,3.0\n", "line 4: column 4 is not a finite number"},
      {"2.0,-22.9,-43.1,1e999,0.1,-0.2,3.0\n", "line 4: column 4 is not a finite number"},
      {"2.0,-22.9,,10,0.1,-0.2,3.0\n", "line 4: column 3 is not a finite number"},
      {"2.0,-22.9,-43.1,10,0.1,-0.2,3.0rad\n", "line 4: column 7 is not a finite number"},
      {"2.0,-92.9,-43.1,10,0.1,-0.2,3.0\n", "line 4: latitude or longitude is out of range"},
      {"1e300,-22.9,-43.1,10,0.1,-0.2,3.0\n", "line 4: the time is out of range"},
      {"1.5,-22.9,-43.1,10,0.1,-0.2,3.0\n", "line 4: the time does not rise"},
      {"\n", "line 4: column 1 is not a finite number"}};
  for (const auto& [row, reason] : bad_rows) {
    EXPECT_NE(reason_for(kHeader + kTwoRows + row).find(reason), std::string::npos) << row;
  }
  EXPECT_NE(reason_for(kHeader).find("two samples at least"), std::string::npos);
}

TEST(TruthFile, RefusesDamagedGzip) {
  const std::string whole = read_bytes(flight_folder() / "stock_path6_truth.csv.gz");
  ASSERT_FALSE(whole.empty());
  EXPECT_NO_THROW(gunzip(whole, "whole"));
  EXPECT_THROW(gunzip(whole.substr(0, whole.size() / 2), "cut"), std::runtime_error);
  EXPECT_THROW(gunzip("", "empty"), std::runtime_error);
  EXPECT_THROW(gunzip("time_boot_s,lat", "plain"), std::runtime_error);
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(~damaged[damaged.size() / 2]);
  EXPECT_THROW(gunzip(damaged, "damaged"), std::runtime_error);
}

TEST(TruthFile, RefusesWhatUnpacksToMoreThanAllowed) {
  const std::string whole = read_bytes(flight_folder() / "stock_path6_truth.csv.gz");
  EXPECT_THROW(gunzip(whole, "bomb", 100'000), std::runtime_error);
}

TEST(TruthFile, SaysWhichFileIsMissing) {
  try {
    read_truth_file("/nowhere/flight_truth.csv.gz");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/flight_truth.csv.gz"), std::string::npos);
  }
}

}  // namespace
}  // namespace geoloc::sim
