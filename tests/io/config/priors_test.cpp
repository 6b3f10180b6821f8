// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "geoloc/io/config/calibration_file.hpp"
#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/config/known_points_file.hpp"

namespace geoloc::io {
namespace {

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(KnownPointsFile, HoldsPlacesWithWhatIsKnownOfThem) {
  const auto points = parse_known_points(R"({"type": "FeatureCollection", "features": [
      {"geometry": {"type": "Point", "coordinates": [-43.133, -22.906]}, "properties": {"id": "gate", "sigma_m": 0.2, "class_id": 3}},
      {"geometry": {"type": "Point", "coordinates": [8.5, 47.4, 400.0]}, "properties": {"id": 17}},
      {"geometry": {"type": "Point", "coordinates": [0, 0]}}]})",
                                         "x");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].name, "gate");
  EXPECT_DOUBLE_EQ(points[0].position.latitude_deg, -22.906);
  EXPECT_DOUBLE_EQ(points[0].position.longitude_deg, -43.133);
  EXPECT_DOUBLE_EQ(points[0].sigma_m, 0.2);
  EXPECT_EQ(points[0].class_id, 3);
  EXPECT_EQ(points[1].name, "17");
  EXPECT_EQ(points[1].class_id, std::nullopt);
  EXPECT_EQ(points[2].name, "2");
  EXPECT_DOUBLE_EQ(points[2].sigma_m, 0.05);
  EXPECT_EQ(points[0].sigma_height_m, 0.0);
  EXPECT_DOUBLE_EQ(points[1].height_m, 400.0);
  EXPECT_DOUBLE_EQ(points[1].sigma_height_m, 0.05);
}

TEST(KnownPointsFile, HasHeightsAndTheirSigmasWhereTheyAreNotAllZero) {
  const auto read = [](const char* height, const char* properties) {
    return parse_known_points(std::string(R"({"features": [{"geometry": {"coordinates": [1, 2, )") + height +
                                  "]}, \"properties\": " + properties + "}]}",
                              "x")[0];
  };
  EXPECT_EQ(read("0", "{}").sigma_height_m, 0.0);
  EXPECT_EQ(read("7", "{}").sigma_height_m, 0.05);
  EXPECT_EQ(read("7", R"({"sigma_height_m": 0.3})").sigma_height_m, 0.3);
  EXPECT_EQ(read("7", R"({"sigma_height_m": 0})").sigma_height_m, 0.0);
  EXPECT_NE(refusal([&] { read("null", "{}"); }).find("height must be a number"), std::string::npos);
  EXPECT_NE(refusal([&] { read("7", R"({"sigma_height_m": -1})"); }).find("sigma_height_m"),
            std::string::npos);
}

TEST(KnownPointsFile, IsRefusedWithFeatureAndReason) {
  const auto features = [](const std::string& list) {
    return refusal([&] { parse_known_points("{\"features\": [" + list + "]}", "marks.geojson"); });
  };
  EXPECT_EQ(refusal([] { parse_known_points("[]", "marks.geojson"); }),
            "marks.geojson: not a GeoJSON FeatureCollection");
  EXPECT_EQ(features(""), "marks.geojson: holds no point");
  EXPECT_NE(features("7").find("feature 0: must be a Point"), std::string::npos);
  EXPECT_NE(features(R"({"geometry": {"coordinates": [47.4, 98.5]}})").find("lon, lat order?"),
            std::string::npos);
  EXPECT_NE(features(R"({"geometry": {"coordinates": [1, "2"]}})").find("latitude must be a number"),
            std::string::npos);
  EXPECT_NE(
      features(R"({"geometry": {"coordinates": [1, 2]}, "properties": {"sigma_m": 0}})").find("sigma_m"),
      std::string::npos);
  EXPECT_NE(
      features(R"({"geometry": {"coordinates": [1, 2]}, "properties": {"class_id": -1}})").find("class_id"),
      std::string::npos);
}

TEST(KnownPointsFile, AsASettingIsAcceptedBack) {
  GeolocatorConfig config, back;
  config.known_points.resize(2);
  config.known_points[0].name = "gate";
  config.known_points[0].position = {1.0, 2.0};
  config.known_points[1].class_id = 4;
  std::vector<std::string> problems;
  geolocator_from_json(geolocator_to_json(config), back, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(geolocator_to_json(back), geolocator_to_json(config));
}

constexpr const char* kLearnt =
    R"({"boresight_x_deg": {"value": 0.5, "sigma": 0.1}, "boresight_y_deg": {"value": -0.2, "sigma": 0.12},
    "boresight_z_deg": {"value": 1.0, "sigma": 0.3}, "latency_s": {"value": 0.11, "sigma": 0.01}, "height_offset_m": {"value": 3, "sigma": 0.1}})";

TEST(CalibrationFile, OfAnEarlierFlightIsThePriorOfTheNext) {
  for (const std::string& text :
       {std::string(kLearnt),
        "{\"type\": \"FeatureCollection\", \"calibration\": " + std::string(kLearnt) + "}"}) {
    const CalibrationPrior prior = parse_calibration(text, "flight1.geojson", {}, 0.4);
    EXPECT_DOUBLE_EQ(prior.boresight_x_deg, 0.5);
    EXPECT_DOUBLE_EQ(prior.sigma_boresight_y_deg, 0.12);
    EXPECT_DOUBLE_EQ(prior.sigma_boresight_z_deg, 0.5);  // with the compass' own 0.4
    EXPECT_DOUBLE_EQ(prior.latency_s, 0.11);
    EXPECT_DOUBLE_EQ(prior.height_m, 0.0);  // of that flight alone
  }
}

/// Files of flights that took it as known have none.
TEST(CalibrationFile, TellsTheFocalLengthWhereItWasEstimated) {
  CalibrationPrior told;
  told.sigma_focal_percent = 5.0;
  EXPECT_EQ(parse_calibration(kLearnt, "flight1.geojson", told, 0.4).sigma_focal_percent, 5.0);
  std::string learnt = kLearnt;
  learnt.insert(1, R"("focal_percent": {"value": -2.5, "sigma": 0.4}, )");
  const CalibrationPrior prior = parse_calibration(learnt, "flight1.geojson", told, 0.4);
  EXPECT_DOUBLE_EQ(prior.focal_percent, -2.5);
  EXPECT_DOUBLE_EQ(prior.sigma_focal_percent, 0.4);
}

TEST(CalibrationFile, IsRefusedWithTheReason) {
  const auto read = [](const char* text) { return refusal([&] { parse_calibration(text, "f", {}, 0.4); }); };
  EXPECT_NE(read("{\"calibration\": null}").find("--method joint"), std::string::npos);
  EXPECT_NE(read("{}").find("boresight_x_deg.value must be a number"), std::string::npos);
  std::string exact = kLearnt;
  exact.replace(exact.find("0.01}"), 4, "0.00");
  EXPECT_NE(read(exact.c_str()).find("latency_s.sigma must be > 0"), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
