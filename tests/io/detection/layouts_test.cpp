// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "fixtures.hpp"
#include "io/detection/remedies.hpp"
#include "support/source_tree.hpp"
#include "support/temporary_folder.hpp"

// The networks of tools/fixtures/make_onnx_fixtures.py list the same boxes in every layout: 12 x 6 px in the
// middle of red cells of 8 px.
namespace geoloc::io {
namespace {

/// 192 x 128 px, twice the networks' input: a red cell of 16 px in the given column and row.
cv::Mat picture_with_cell(int column, int row) {
  cv::Mat picture{128, 192, CV_8UC3, cv::Scalar::all(114)};
  picture(cv::Rect{16 * column, 16 * row, 16, 16}).setTo(kRed);
  return picture;
}

void expect_box(const std::vector<Detection>& found, double width_px, double height_px, double confidence) {
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.x + found[0].box.width / 2, 16 * 5 + 8, 1e-3);
  EXPECT_NEAR(found[0].box.y + found[0].box.height / 2, 16 * 3 + 8, 1e-3);
  EXPECT_NEAR(found[0].box.width, width_px, 1e-3);
  EXPECT_NEAR(found[0].box.height, height_px, 1e-3);
  EXPECT_NEAR(found[0].confidence, confidence, 0.02);
  EXPECT_EQ(found[0].class_id, 0);
}

class EachBackendsLayouts : public ::testing::TestWithParam<Backend> {
 protected:
  static std::vector<Detection> found_by(const std::string& model,
                                         OutputLayout layout = OutputLayout::kAuto) {
    YoloDetector detector{{fixture(model), {}}, with(GetParam(), layout)};
    EXPECT_EQ(detector.counts().rejected_boxes, 0U);
    return detector.detect(picture_with_cell(5, 3));
  }

  static void expect_refused(const std::string& model, const std::vector<std::string>& words,
                             OutputLayout layout = OutputLayout::kAuto) {
    const std::string fault = fault_of({fixture(model), {}}, with(GetParam(), layout));
    EXPECT_NE(fault.find(fixture(model).string()), std::string::npos) << fault;
    for (const std::string& word : words) EXPECT_NE(fault.find(word), std::string::npos) << fault;
  }
};

INSTANTIATE_TEST_SUITE_P(Layouts, EachBackendsLayouts, ::testing::ValuesIn(backends()), backend_name);

TEST_P(EachBackendsLayouts, FindsTheSameBoxInEveryLayout) {
  for (const char* model : {"plain", "two_outputs", "end2end", "end2end_by_shape", "pose", "segment",
                            "segment_prototypes_first", "rtdetr", "rtdetr_top"}) {
    SCOPED_TRACE(model);
    expect_box(found_by(model), 24, 12, 1.0);
  }
}

TEST_P(EachBackendsLayouts, WeighsClassesByTheScoreOfAnyObject) {
  expect_box(found_by("yolov5"), 24, 12, 0.9);
  expect_box(found_by("yolov5_unnamed"), 24, 12, 0.9);
}

TEST_P(EachBackendsLayouts, GivesYoloxItsGridAndAPictureAsItIs) {
  expect_box(found_by("yolox", OutputLayout::kYolox), 24, 12, 0.9);
}

TEST_P(EachBackendsLayouts, BoundsRotatedBoxes) {
  const double cosine = std::cos(M_PI / 6), sine = std::sin(M_PI / 6);
  for (const char* model : {"obb", "end2end_obb"}) {
    SCOPED_TRACE(model);
    expect_box(found_by(model), 2 * (12 * cosine + 6 * sine), 2 * (12 * sine + 6 * cosine), 1.0);
  }
}

TEST_P(EachBackendsLayouts, StretchesPicturesForRtdetrAlone) {
  cv::Mat wide;
  cv::resize(picture_with_cell(5, 3), wide, {384, 128}, 0, 0, cv::INTER_NEAREST);
  YoloDetector rtdetr{{fixture("rtdetr"), {}}, with(GetParam())};
  const auto found = rtdetr.detect(wide);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.x + found[0].box.width / 2, 2 * (16 * 5 + 8), 1e-3);
  EXPECT_NEAR(found[0].box.width, 48, 1e-3);
  EXPECT_NEAR(found[0].box.height, 12, 1e-3);
}

TEST_P(EachBackendsLayouts, AsksForTheLayoutWhereNothingTellsIt) {
  expect_refused("transposed", {"end2end or rtdetr", "detection.layout (--layout)"});
  expect_refused("yolox", {"yolox", "detection.layout (--layout)"});
  expect_refused("odd_classes", {"no whole number below 3", "detection.layout (--layout)"});
  expect_refused("plain", {"not [1, candidates, 5 + classes]", "yolov5"}, OutputLayout::kYolov5);
}

TEST_P(EachBackendsLayouts, AsksForNamesWhereNothingTellsHowManyClassesThereAre) {
  expect_refused("end2end_unnamed", {"--class-names FILE"});
  const testing::TemporaryFolder folder;
  YoloDetector named{{fixture("end2end_unnamed"), folder.write("names.txt", "red\nblue\nnothing\n")},
                     with(GetParam())};
  expect_box(named.detect(picture_with_cell(5, 3)), 24, 12, 1.0);
}

TEST_P(EachBackendsLayouts, RefusesWhatListsNoBoxes) {
  expect_refused("classify", {"task classify", "detect, obb, segment or pose"});
  expect_refused("three_outputs", {"3 outputs", "docs/detection.md"});
  expect_refused("batch_of_two", {"[2, 3, 64, 96]", "export again with batch=1"});
}

TEST_P(EachBackendsLayouts, TakesTheConfidenceThatSuitsTheModel) {
  const DetectorFiles other{fixture("plain"), {}}, ours{fixture("with_sigma"), {}};
  EXPECT_EQ(with_model_defaults(other, {}).confidence, kConfidenceOfOtherModels);
  EXPECT_EQ(with_model_defaults(ours, {}).confidence, kConfidenceOfOurModels);
  DetectionConfig config = with(GetParam());
  config.confidence = 0.6;
  EXPECT_EQ(with_model_defaults(ours, config).confidence, 0.6);

  cv::Mat faint = picture_with_cell(5, 3);
  faint(cv::Rect{80, 48, 16, 16}).setTo(cv::Scalar{90, 90, 200});  // red less the others: about 0.43
  EXPECT_EQ(YoloDetector(other, with(GetParam())).detect(faint).size(), 1U);
  EXPECT_TRUE(YoloDetector(ours, with(GetParam())).detect(faint).empty());
}

/// Networks that choose their boxes need operators that OpenCV 4.6 lacks and that no conversion takes away.
TEST(Refusals, LeadToWhatWorks) {
  const std::string fault = fault_of({fixture("chosen_by_topk"), {}}, with(Backend::kOpencv));
  if (fault != "none") {
    EXPECT_NE(fault.find("--backend openvino"), std::string::npos) << fault;
    EXPECT_NE(fault.find("export it again so that it does not choose boxes itself"), std::string::npos)
        << fault;
    EXPECT_EQ(fault.find("onnx_for_opencv"), std::string::npos) << fault;
    EXPECT_EQ(fault.find("scripts/openvino.sh") == std::string::npos, has_openvino()) << fault;
  }
  if (!has_openvino()) return;
  YoloDetector detector{{fixture("chosen_by_topk"), {}}, with(Backend::kOpenvino)};
  expect_box(detector.detect(picture_with_cell(5, 3)), 24, 12, 1.0);
}

/// The quoted names in the program's sets of operators.
std::set<std::string> operators_of_the_converter() {
  std::ifstream stream{source_tree() / "tools/onnx_for_opencv.py"};
  const std::string program{std::istreambuf_iterator<char>{stream}, {}};
  std::istringstream sets{program.substr(program.find("BROADCASTING = {"))};
  std::set<std::string> names;
  std::string between, name;
  while (std::getline(sets, between, '"') && between.find("OPENVINO = ") == std::string::npos) {
    if (std::getline(sets, name, '"')) names.insert(name);
  }
  return names;
}

TEST(Refusals, PromiseAConversionOfJustWhatTheConverterTakes) {
  std::istringstream words{std::string{kConvertibleOperators}};
  const std::set<std::string> promised{std::istream_iterator<std::string>{words}, {}};
  EXPECT_EQ(operators_of_the_converter(), promised);
}

TEST(Refusals, OfHalfPrecisionDoNotPromiseAConversion) {
  if (opencv_runs_exports()) GTEST_SKIP() << "this OpenCV runs it";
  const std::string fault = fault_of({fixture("half_precision"), {}}, with(Backend::kOpencv));
  EXPECT_NE(fault.find("half=False"), std::string::npos) << fault;
  EXPECT_EQ(fault.find("onnx_for_opencv"), std::string::npos) << fault;
}

TEST(Refusals, OfAnOpenSizeNameTheConversionWithASizeWhereItIsNeeded) {
  const std::string fault = fault_of({fixture("dynamic_size"), {}}, with(Backend::kOpencv));
  EXPECT_NE(fault.find("--input-size"), std::string::npos) << fault;
  EXPECT_EQ(fault.find("onnx_for_opencv") == std::string::npos, opencv_runs_exports()) << fault;
}

}  // namespace
}  // namespace geoloc::io
