// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "support/source_tree.hpp"

// The oracle is ONNX Runtime with a letterbox and a suppression written in numpy:
// tools/fixtures/make_detection_fixture.py.
namespace geoloc::io {
namespace {

constexpr double kTolerance_px = 0.1;
constexpr double kMargin = 0.01;  // a score so close to the threshold may fall on either side of it

std::vector<Detection> expected_detections(const nlohmann::json& fixture) {
  std::vector<Detection> detections;
  for (const auto& entry : fixture.at("detections")) {
    const auto box = entry.at("box").get<std::array<double, 4>>();
    detections.push_back({{box[0], box[1], box[2], box[3]},
                          entry.at("confidence"),
                          entry.at("class_id"),
                          entry.at("sigma_px")});
  }
  return detections;
}

bool is_same(const Detection& a, const Detection& b) {
  const double differences[] = {a.box.x - b.box.x, a.box.y - b.box.y, a.box.width - b.box.width,
                                a.box.height - b.box.height, a.sigma_px - b.sigma_px};
  const auto is_small = [](double d) { return std::abs(d) < kTolerance_px; };
  return a.class_id == b.class_id && std::abs(a.confidence - b.confidence) < kMargin &&
         std::all_of(std::begin(differences), std::end(differences), is_small);
}

/// Expects that every clear detection of one list is in the other.
void expect_contains(const std::vector<Detection>& all, const std::vector<Detection>& wanted,
                     const DetectionConfig& config) {
  for (const Detection& detection : wanted) {
    if (detection.confidence < config.confidence + kMargin) continue;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                            [&](const Detection& other) { return is_same(detection, other); }))
        << detection.box.x << " " << detection.box.y << " confidence " << detection.confidence;
  }
}

struct Picture {
  std::string name;
  std::size_t least_detections;
};

void PrintTo(const Picture& picture, std::ostream* out) {
  *out << picture.name;
}

class DefaultModel : public ::testing::TestWithParam<Picture> {};

/// In the second picture, the second look is doubtful about nine boxes and looks again.
INSTANTIATE_TEST_SUITE_P(Pictures, DefaultModel,
                         ::testing::Values(Picture{"targets", 5}, Picture{"doubtful", 4}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(DefaultModel, FindsWhatOnnxRuntimeFinds) {
  const auto data = test_data() / "detection";
  const auto model = source_tree() / "data/models/fiducial.onnx";
  const auto fixture = nlohmann::json::parse(std::ifstream{data / (GetParam().name + ".json")});

  DetectionConfig config;
  config.confidence = 0.4;
  config.nms_iou = 0.5;
  const auto detector = open_detector({model, {}}, config);
  const auto found = detector->detect(cv::imread((data / (GetParam().name + ".jpg")).string()));
  const auto expected = expected_detections(fixture);
  EXPECT_GE(expected.size(), GetParam().least_detections);
  SCOPED_TRACE("after a change of the model: tools/fixtures/make_detection_fixture.py");
  expect_contains(found, expected, config);
  expect_contains(expected, found, config);
}

}  // namespace
}  // namespace geoloc::io
