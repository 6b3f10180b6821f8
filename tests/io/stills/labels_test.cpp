// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/labels.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace geoloc::io {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    parse_labels(text, "labels");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Labels, OfASurveyAreMarksAndWhereTheyAreInPictures) {
  const Labels labels = parse_labels(
      "EPSG:4326\r\n16.47 47.64 463.6 2501.5 2452.25 DIR/MAX_0029.JPG 1\r\n"
      "16.48 47.65 461.7 100 200 MAX_0029.JPG 2\n16.47 47.64 463.6 7 8 b.jpg 1\n",
      "labels");
  ASSERT_EQ(labels.marks.size(), 2U);
  EXPECT_EQ(labels.marks[1].name, "2");
  EXPECT_DOUBLE_EQ(labels.marks[1].position.latitude_deg, 47.65);
  EXPECT_DOUBLE_EQ(labels.marks[1].position.longitude_deg, 16.48);
  EXPECT_EQ(labels.marks[1].height_m, 461.7);
  ASSERT_EQ(labels.by_picture.size(), 2U);
  const auto& detections = labels.by_picture.at(label_key("elsewhere/max_0029.jpg"));
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].box.centre(), Eigen::Vector2d(2501.5, 2452.25));  // OpenCV's pixels
}

TEST(Labels, OfASurveyMayBeProjected) {
  for (const char* system : {"EPSG:32633", "WGS84 UTM 33N", "+proj=utm +zone=33 +datum=WGS84"}) {
    const Labels labels = parse_labels(std::string(system) + "\n561538 5277187 10 1 2 a.jpg\n", "labels");
    const auto utm = to_utm(labels.marks.at(0).position);  // by GeographicLib
    ASSERT_TRUE(utm) << system;
    EXPECT_EQ(utm->zone, 33) << system;
    EXPECT_NEAR(utm->easting_m, 561538.0, 1e-4) << system;
    EXPECT_NEAR(utm->northing_m, 5277187.0, 1e-4) << system;
  }
}

TEST(Labels, OfATableNameTheirColumns) {
  const Labels labels =
      parse_labels("u,picture,v,class_id,confidence,width,height\n10,a.jpg,20,3,0.5,8,6\n", "labels");
  const Detection& detection = labels.by_picture.at("a.jpg").at(0);
  EXPECT_EQ(detection.box.centre(), Eigen::Vector2d(10, 20));
  EXPECT_EQ(detection.box.width, 8.0);
  EXPECT_EQ(detection.box.height, 6.0);
  EXPECT_EQ(detection.class_id, 3);
  EXPECT_EQ(detection.confidence, 0.5);
  EXPECT_TRUE(labels.marks.empty());
}

TEST(Labels, OfAPictureWithoutPixelsTellThatNothingWasSeen) {
  const Labels labels = parse_labels("picture,u,v\na.jpg,,\n", "labels");
  EXPECT_TRUE(labels.by_picture.at("a.jpg").empty());
}

TEST(Labels, MayBeWhatADetectorWrote) {
  const Labels labels = parse_labels(
      R"({"image": "set/1.jpg", "detections": [{"box": [1, 2, 3, 4], "class_id": 2, "class_name": "car", "sigma_px": 0.3}]})"
      "\n"
      R"({"image": "set/2.jpg", "detections": []})",
      "labels");
  const Detection& detection = labels.by_picture.at("1.jpg").at(0);
  EXPECT_EQ(detection.box.width, 3.0);
  EXPECT_EQ(detection.sigma_px, 0.3);
  EXPECT_EQ(labels.class_names, (std::vector<std::string>{"", "", "car"}));
  EXPECT_TRUE(labels.by_picture.at("2.jpg").empty());
}

TEST(Labels, OfAVideoGoByTheNumbersOfItsFrames) {
  const Labels labels = parse_labels(R"({"image": "a.mp4", "frame": 12, "detections": []})", "labels");
  EXPECT_EQ(labels.by_picture.count("12"), 1U);
}

TEST(Labels, ThatAreWrongAreRefusedByLineAndReason) {
  EXPECT_EQ(refusal_of("picture,u,v\na.jpg,1,2\na.jpg,x,2\n"), "labels:3: u is no number: `x`");
  EXPECT_EQ(refusal_of("picture,u\n"), "labels:1: there is no column `v`");
  EXPECT_EQ(refusal_of("EPSG:4326\n1 2 3\n"), "labels:2: x y z u v picture is expected");
  EXPECT_EQ(refusal_of(R"({"image": "a.jpg", "detections": [{"box": [1, 2, 0, 4]}]})"),
            "labels:1: box has no size");
  EXPECT_EQ(refusal_of(R"({"image": "a.mp4", "frame": -1, "detections": []})"),
            "labels:1: frame must be a whole number from 0");
  EXPECT_EQ(refusal_of("EPSG:4326\n"), "labels: holds no label");
  EXPECT_EQ(refusal_of(""), "labels: holds no label");
  EXPECT_NE(refusal_of("http://127.0.0.1/wkt\n1 2 3 4 5 a.jpg\n").find("no coordinate system"),
            std::string::npos);
  EXPECT_NE(refusal_of("EPSG:4326\n200 95 3 4 5 a.jpg\n").find("no place"), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
