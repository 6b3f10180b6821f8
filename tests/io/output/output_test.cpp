// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <nlohmann/json.hpp>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/output/run_picture.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

ObjectReport some_object() {
  ObjectReport object;
  object.id = 17;
  object.class_name = "target";
  object.confidence = 0.87654;
  object.hits = 12;
  object.first_seen = HostTime{std::chrono::milliseconds{1'795'339'800'123}};
  object.last_seen = object.first_seen + std::chrono::seconds{2};
  object.position = {-22.90612345678912, -43.13398765432198};
  object.ellipse = {0.123456, 0.05, 42.0};
  return object;
}

TEST(ErrorEllipse, IsTheAxesOfTheCovariance) {
  for (const double azimuth_deg : {0.0, 30.0, 90.0, 135.0, 179.0}) {
    const double azimuth = azimuth_deg * kRadPerDeg;
    Eigen::Matrix2d axes;  // columns: along the azimuth, and across
    axes << std::sin(azimuth), std::cos(azimuth), std::cos(azimuth), -std::sin(azimuth);
    const Eigen::Matrix2d covariance = axes * Eigen::Vector2d(4.0, 0.25).asDiagonal() * axes.transpose();
    const ErrorEllipse ellipse = error_ellipse(covariance);
    EXPECT_NEAR(ellipse.sigma_major_m, 2.0, 1e-9);
    EXPECT_NEAR(ellipse.sigma_minor_m, 0.5, 1e-9);
    EXPECT_NEAR(std::remainder(ellipse.azimuth_deg - azimuth_deg, 180.0), 0.0, 1e-6);
  }
}

TEST(Iso8601, IsUtcWithMilliseconds) {
  // date -u -d @1795339800 +%FT%T
  EXPECT_EQ(iso8601(HostTime{std::chrono::milliseconds{1'795'339'800'123}}), "2026-11-22T09:30:00.123Z");
  EXPECT_EQ(iso8601(HostTime{}), "1970-01-01T00:00:00.000Z");
}

TEST(GeoJson, HoldsTheFieldsOfTheFormat) {
  const auto json = nlohmann::json::parse(objects_to_geojson({some_object()}, {}));
  EXPECT_EQ(json["type"], "FeatureCollection");
  const auto& feature = json["features"].at(0);
  EXPECT_EQ(feature["geometry"]["type"], "Point");
  EXPECT_DOUBLE_EQ(feature["geometry"]["coordinates"][0], -43.133987654);
  EXPECT_DOUBLE_EQ(feature["geometry"]["coordinates"][1], -22.906123457);
  for (const char* key : {"id", "class_id", "class_name", "confidence", "hits", "first_seen", "last_seen",
                          "sigma_major_m", "sigma_minor_m", "sigma_azimuth_deg"}) {
    EXPECT_TRUE(feature["properties"].contains(key)) << key;
  }
  EXPECT_TRUE(json.contains("counters"));
  EXPECT_TRUE(json.contains("calibration"));
}

TEST(GeoJson, HostileClassNamesStayText) {
  ObjectReport object = some_object();
  object.class_name = "\"]}\xff\x01<script>";
  const auto json = nlohmann::json::parse(objects_to_geojson({object}, {}));
  EXPECT_NE(json["features"][0]["properties"]["class_name"].get<std::string>().find("<script>"),
            std::string::npos);
}

TEST(RawFixes, AreACsvLineEach) {
  const std::string csv =
      raw_fixes_to_csv({{HostTime{}, {{1, 2, 3, 4}, 0.5, 6}, {10.0, 20.0}, 25.0}}, LocalFrame({1.0, 2.0}));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  EXPECT_NE(csv.find("1970-01-01T00:00:00.000Z,1.000180"), std::string::npos) << csv;
}

TEST(RunPicture, LeavesOutWhatIsNotFiniteAndEscapesTexts) {
  RunPicture picture;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  picture.title = "<b>&\"\x01";
  picture.raw_fixes = {{nan, 1.0}, {3.0, 4.0}};
  picture.trajectory = {{0, 0}, {nan, nan}, {10, 5}};
  picture.objects = {some_object()};
  const std::string svg = to_svg(picture);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("&lt;b&gt;&amp;&quot;</text>"), std::string::npos);
}

TEST(RunPicture, OfNothingIsStillAPicture) {
  const std::string svg = to_svg({});
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(AtomicFile, ReplacesTheOldContentOrLeavesIt) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("objects.geojson", "old");
  write_file_atomically(file, "new");
  std::ifstream input(file);
  std::string content;
  input >> content;
  EXPECT_EQ(content, "new");
  EXPECT_THROW(write_file_atomically(folder.path() / "none" / "x", "new"), std::runtime_error);
  EXPECT_THROW(write_file_atomically("/dev/full", "new"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));                         // not replaced
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);  // nothing left beside
}

}  // namespace
}  // namespace geoloc::io
