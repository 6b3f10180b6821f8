// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/config/geolocator_fields.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

std::vector<std::string> read(const nlohmann::json& json, GeolocatorConfig& config) {
  std::vector<std::string> problems;
  geolocator_from_json(json, config, problems);
  return problems;
}

TEST(GeolocatorFields, WhatIsPrintedIsAcceptedBack) {
  GeolocatorConfig config;
  config.camera_orientation = CameraOrientation::kAddedAngles;
  config.state.max_gap_s = 0.25;
  config.paper.gate = 2.5;
  config.camera.mount.yaw_deg = 90.0;
  GeolocatorConfig back;
  EXPECT_TRUE(read(geolocator_to_json(config), back).empty());
  EXPECT_EQ(geolocator_to_json(back), geolocator_to_json(config));
}

TEST(GeolocatorFields, FaultsOfAllStagesAreNamedByTheirPath) {
  GeolocatorConfig config;
  const auto problems = read(nlohmann::json::parse(R"({"method": "magic", "paper": {"gate": -1, "gait": 3},
      "camera": {"width": 0, "lens": 1, "horizontal_fov_deg": 400}, "colour": 1})"),
                             config);
  const std::string all = ::testing::PrintToString(problems);
  for (const char* expected :
       {"method must be one of: paper, joint", "paper.gate must lie in (0, 100], but is -1",
        "paper.gait is not a setting", "camera.lens is not a setting",
        "camera.horizontal_fov_deg must lie in (0, 175), but is 400",
        "camera.width must lie in [1, 32768], but is 0", "colour is not a setting"}) {
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in " << all;
  }
}

TEST(GeolocatorFields, AMissingCalibrationFileIsAFaultLikeAnyOther) {
  GeolocatorConfig config;
  const auto problems = read({{"camera", "/nowhere/camera.yaml"}}, config);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("/nowhere/camera.yaml"), std::string::npos);
}

TEST(GeolocatorFields, AKnownPointIsCheckedLikeAnyOtherSetting) {
  GeolocatorConfig config;
  const auto problems = read(
      nlohmann::json::parse(R"({"known_points": [{"latitude_deg": 91, "sigma_m": 0}, {"lat": 1}]})"), config);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].find("known_points[1].lat is not a setting"), 0U);
  EXPECT_EQ(problems[1], "known_points[0].latitude_deg must lie in [-90, 90], but is 91");
  EXPECT_EQ(problems[2], "known_points[0].sigma_m must lie in (0, 100], but is 0");
}

}  // namespace
}  // namespace geoloc::io
