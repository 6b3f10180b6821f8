// SPDX-License-Identifier: Apache-2.0
// Names and numbers that no format may fail on.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "geoloc/io/output/cot_event.hpp"
#include "geoloc/io/output/csv.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/json_lines.hpp"
#include "geoloc/io/output/kml.hpp"
#include "geoloc/io/output/run_picture.hpp"

namespace geoloc::io {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string>& hostile_names() {
  static const std::vector<std::string> names{"</name><script>alert(1)</script>",
                                              "\" onload=\"x",
                                              "]]>&amp;&#0;<!--",
                                              "a,\"b\"\r\n1,2",
                                              std::string("nul\0\x1B[31m\x7F", 9),
                                              "\xFF\xC0\x80\xED\xA0\x80",
                                              "=cmd|' /C calc'!A0",
                                              std::string(100'000, '<')};
  return names;
}

ObjectReport object_called(const std::string& name) {
  ObjectReport object;
  object.id = 17;
  object.class_name = name;
  object.position = {-22.9, -43.1};
  object.position_in_enu = {1.0, 2.0};
  object.covariance_in_enu << 0.04, 0.0, 0.0, 0.01;
  object.ellipse = {0.2, 0.1, 90.0};
  return object;
}

RunRecord run_of(const ObjectReport& object) {
  RunRecord run;
  run.title = object.class_name;
  run.summary = object.class_name;
  run.objects = {object};
  run.local_frame.emplace(Geodetic{-22.9, -43.1});
  run.trajectory = {{HostTime{}, {0.0, 0.0, 20.0}}, {HostTime{}, {kNan, 0.0, 20.0}}};
  return run;
}

/// Expects no control character except newlines, and as many tags opened as closed.
void expect_sound_markup(const std::string& text) {
  int depth = 0;
  for (const char character : text) {
    EXPECT_TRUE(static_cast<unsigned char>(character) >= 0x20 || character == '\n');
    if (character == '<') ++depth;
    if (character == '>') --depth;
    ASSERT_TRUE(depth == 0 || depth == 1);
  }
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(text.find("<script"), std::string::npos);
}

TEST(HostileNames, StayTextInMarkup) {
  for (const std::string& name : hostile_names()) {
    const ObjectReport object = object_called(name);
    expect_sound_markup(run_to_kml(run_of(object)));
    expect_sound_markup(to_svg(picture_of(run_of(object))));
    expect_sound_markup(to_cot(object, {"geoloc.0.17", HostTime{}, false}, {}));
  }
}

TEST(HostileNames, FitADatagramAsCot) {
  for (const std::string& name : hostile_names()) {
    ObjectReport object = object_called(name);
    object.height.ellipsoid_m = 690.0;
    EXPECT_LT(to_cot(object, {"geoloc.0.17", HostTime{}, false}, {}).size(), 1400U);
  }
}

TEST(HostileNames, StayOneLineAndOneFieldInCsv) {
  for (const std::string& name : hostile_names()) {
    const std::string csv = objects_to_csv({object_called(name)});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  }
  EXPECT_EQ(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csv_field("=1+1"), "'=1+1");
}

TEST(HostileNames, StayOneLineOfJson) {
  for (const std::string& name : hostile_names()) {
    OutputFrame frame;
    frame.objects = {object_called(name)};
    const std::string lines = JsonLines().frame(frame);
    ASSERT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
    const auto object = nlohmann::json::parse(lines.substr(lines.find('\n') + 1));
    EXPECT_EQ(object["id"], 17);
    EXPECT_TRUE(nlohmann::json::accept(objects_to_geojson(frame.objects, {})));
  }
}

TEST(FiguresThatAreNone, AreLeftOutOfEveryFormat) {
  ObjectReport object = object_called("target");
  object.ellipse = {kNan, kNan, kNan};
  object.covariance_in_enu.setConstant(kNan);
  object.confidence = kNan;
  object.height = {kNan, kNan, kNan, kNan};
  OutputFrame frame;
  frame.objects = {object};
  const std::string cot = to_cot(object, {"geoloc.0.17", HostTime{}, false}, {});
  EXPECT_NE(cot.find("ce=\"9999999.00\""), std::string::npos) << cot;
  for (const std::string& text : {objects_to_csv({object}), objects_to_geojson({object}, {}),
                                  JsonLines().frame(frame), run_to_kml(run_of(object))}) {
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
    EXPECT_NE(text.find("-22.9"), std::string::npos);
  }
}

TEST(ObjectsWithoutAPlace, AreInNoFormat) {
  ObjectReport object = object_called("target");
  object.position.latitude_deg = kNan;
  OutputFrame frame;
  frame.objects = {object};
  EXPECT_EQ(objects_to_csv({object}).find("target"), std::string::npos);
  EXPECT_EQ(objects_to_geojson({object}, {}).find("target"), std::string::npos);
  EXPECT_EQ(JsonLines().frame(frame).find("target"), std::string::npos);
  EXPECT_EQ(run_to_kml(run_of(object)).find(">17<"), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
