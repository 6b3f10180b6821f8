// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core/version.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "fixtures.hpp"
#include "support/source_tree.hpp"
#include "support/temporary_folder.hpp"

// The networks are described in tools/fixtures/make_onnx_fixtures.py: what they find is known in closed form.
namespace geoloc::io {
namespace {

const cv::Scalar kBlue{255, 0, 0};

/// 192 x 64 px: in the network's 96 x 64 px at half the size, between bars of 16 px. Its cells are 16 px wide
/// and high.
cv::Mat picture_with_cell(int column, int row, const cv::Scalar& colour) {
  cv::Mat picture{64, 192, CV_8UC3, cv::Scalar::all(114)};
  picture(cv::Rect{16 * column, 16 * row, 16, 16}).setTo(colour);
  return picture;
}

void expect_cell(const std::vector<Detection>& detections, int column, int row, int class_id) {
  ASSERT_EQ(detections.size(), 1U);
  const Box& box = detections[0].box;  // 12 x 6 px around the middle, at twice the size
  EXPECT_NEAR(box.x, 16 * column + 8 - 12, 1e-3);
  EXPECT_NEAR(box.y, 16 * row + 8 - 6, 1e-3);
  EXPECT_NEAR(box.width, 24, 1e-3);
  EXPECT_NEAR(box.height, 12, 1e-3);
  EXPECT_NEAR(detections[0].confidence, 1.0, 0.15);  // the cell's edge mixes with its neighbours
  EXPECT_EQ(detections[0].class_id, class_id);
}

/// Tests that run with each back end that was built in.
class EachBackend : public ::testing::TestWithParam<Backend> {
 protected:
  YoloDetector detector(const std::string& model) const {
    return YoloDetector{{fixture(model), {}}, with(GetParam())};
  }
};

INSTANTIATE_TEST_SUITE_P(YoloDetector, EachBackend, ::testing::ValuesIn(backends()), backend_name);

void expect_finds_what_is_there(const std::string& model, const DetectionConfig& config) {
  SCOPED_TRACE(model);
  YoloDetector detector{{fixture(model), {}}, config};
  EXPECT_EQ(detector.input_size().width_px, 96);
  EXPECT_EQ(detector.input_size().height_px, 64);
  expect_cell(detector.detect(picture_with_cell(3, 2, kRed)), 3, 2, 0);
  expect_cell(detector.detect(picture_with_cell(9, 1, kBlue)), 9, 1, 1);
  EXPECT_TRUE(detector.detect(cv::Mat{64, 192, CV_8UC3, cv::Scalar::all(255)}).empty());
  EXPECT_EQ(detector.counts().images, 3U);
  EXPECT_EQ(detector.counts().failed_images, 0U);
}

TEST_P(EachBackend, FindsWhatIsThereWhereItIs) {
  for (const char* model :
       {"plain", "unnamed", "constants_as_inputs", "converted_opset12", "converted_opset17", "dynamic_batch"})
    expect_finds_what_is_there(model, with(GetParam()));
}

TEST_P(EachBackend, GivesAnOpenInputTheConfiguredSize) {
  DetectionConfig config = with(GetParam());
  config.input_width_px = 96;
  config.input_height_px = 64;
  for (const char* model : {"dynamic", "dynamic_size", "plain"}) expect_finds_what_is_there(model, config);
}

TEST_P(EachBackend, KeepsNothingOfAPictureOfAnotherShape) {
  YoloDetector plain = detector("plain");
  ASSERT_EQ(plain.detect(cv::Mat{128, 192, CV_8UC3, kRed}).size(), 96U);
  EXPECT_TRUE(plain.detect(cv::Mat{10, 192, CV_8UC3, cv::Scalar::all(0)}).empty());
  EXPECT_TRUE(plain.detect(cv::Mat{400, 3, CV_8UC3, cv::Scalar::all(0)}).empty());
}

TEST_P(EachBackend, TakesGreyAndTransparentPicturesAndPartsOfPictures) {
  YoloDetector plain = detector("plain");
  cv::Mat transparent;
  cv::cvtColor(picture_with_cell(3, 2, kRed), transparent, cv::COLOR_BGR2BGRA);
  expect_cell(plain.detect(transparent), 3, 2, 0);
  EXPECT_TRUE(plain.detect(cv::Mat{64, 192, CV_8UC1, cv::Scalar{200}}).empty());

  cv::Mat larger{100, 300, CV_8UC3, kBlue};
  picture_with_cell(3, 2, kRed).copyTo(larger(cv::Rect{50, 20, 192, 64}));
  expect_cell(plain.detect(larger(cv::Rect{50, 20, 192, 64})), 3, 2, 0);
  EXPECT_EQ(plain.counts().unusable_images, 0U);
}

TEST_P(EachBackend, TakesPicturesOfAnySize) {
  YoloDetector plain = detector("plain");
  for (const cv::Size size : {cv::Size{1, 1}, {1, 5000}, {5000, 1}, {97, 61}, {12'000, 8'000}})
    plain.detect(cv::Mat{size, CV_8UC3, kRed});
  EXPECT_EQ(plain.counts().failed_images + plain.counts().unusable_images, 0U);
}

TEST_P(EachBackend, CountsWhatIsNoPicture) {
  YoloDetector plain = detector("plain");
  const int cube[] = {4, 4, 4};
  for (const cv::Mat& picture :
       {cv::Mat{}, cv::Mat{64, 192, CV_16UC3, kRed}, cv::Mat{64, 192, CV_32FC3, kRed},
        cv::Mat{64, 192, CV_8UC2, kRed}, cv::Mat{3, cube, CV_8UC3, kRed}}) {
    EXPECT_TRUE(plain.detect(picture).empty());
  }
  EXPECT_EQ(plain.counts().images, 5U);
  EXPECT_EQ(plain.counts().unusable_images, 5U);
}

TEST_P(EachBackend, StatesTheSigmaThatTheModelStates) {
  const cv::Mat picture = picture_with_cell(3, 2, kRed);
  const auto stated = detector("with_sigma").detect(picture);
  ASSERT_EQ(stated.size(), 1U);
  EXPECT_NEAR(stated[0].sigma_px, 2.0 * std::hypot(0.3, 0.05 * std::sqrt(12.0 * 6.0)), 1e-4);
  EXPECT_EQ(detector("plain").detect(picture).at(0).sigma_px, 0.0);
}

TEST_P(EachBackend, RefusesABadConfiguration) {
  DetectionConfig config = with(GetParam());
  config.confidence = 2;
  EXPECT_THROW(YoloDetector({fixture("plain"), {}}, config), std::invalid_argument);
}

TEST(YoloDetector, TakesItsClassNamesFromTheModelOrAFile) {
  using Names = std::vector<std::string>;
  EXPECT_EQ((YoloDetector{{fixture("plain"), {}}, {}}.class_names()), (Names{"red", "driver's blue"}));
  EXPECT_EQ((YoloDetector{{fixture("unnamed"), {}}, {}}.class_names()), (Names{"class 0", "class 1"}));

  const testing::TemporaryFolder folder;
  const auto two_names = folder.write("two.txt", "rouge\r\nbleu\n\n");
  EXPECT_EQ((YoloDetector{{fixture("plain"), two_names}, {}}.class_names()), (Names{"rouge", "bleu"}));
  EXPECT_NE(fault_of({fixture("plain"), folder.write("one.txt", "name\n")}, {}).find("has 1 names"),
            std::string::npos);
  EXPECT_NE(fault_of({fixture("plain"), folder.path() / "none.txt"}, {}).find("cannot be read"),
            std::string::npos);
}

struct BadModel {
  const char* name;
  const char* says;
};

void expect_refused(const BadModel& model, const DetectionConfig& config) {
  const std::string fault = fault_of({fixture(model.name), {}}, config);
  EXPECT_NE(fault.find(fixture(model.name).string()), std::string::npos) << fault;
  EXPECT_NE(fault.find(model.says), std::string::npos) << fault;
}

TEST_P(EachBackend, RefusesABadModelWithItsNameTheFaultAndTheRemedy) {
  for (const BadModel& model :
       {BadModel{"no_such_file", "cannot be read"}, BadModel{"dynamic_size", "[1, 3, ?, ?]"},
        BadModel{"dynamic", "--input-size"}, BadModel{"transposed", "[1, 96, 6]"},
        BadModel{"too_many_names", "3 named classes"}, BadModel{"no_numbers", "NaN"},
        BadModel{"bad_sigma", "geoloc_centre_sigma_px"}})
    expect_refused(model, with(GetParam()));
}

TEST_P(EachBackend, RefusesAnInputSizeThatTheModelDoesNotTake) {
  DetectionConfig config = with(GetParam());
  config.input_width_px = 128;
  config.input_height_px = 64;
  expect_refused({"plain", "not open to the 128 x 64 px"}, config);
  expect_refused({"dynamic_size", ""}, config);  // its boxes are for 96 candidates
}

TEST_P(EachBackend, RefusesFilesThatAreNoModels) {
  const testing::TemporaryFolder folder;
  for (const std::string& content :
       {std::string{}, std::string{"not a model\n"}, std::string(5000, '\xff')}) {
    const auto file = folder.write("model.onnx", content);
    EXPECT_NE(fault_of({file, {}}, with(GetParam())).find(file.string()), std::string::npos);
  }
  EXPECT_NE(fault_of({folder.path(), {}}, with(GetParam())).find("cannot be read"), std::string::npos);
}

/// The message about what OpenCV before 4.8 cannot run names a remedy; from 4.8 on, and with OpenVINO, none
/// is needed.
TEST(Backends, TakeExportsThatAreNotConverted) {
  constexpr bool kOpencvRunsExports =
      CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 8);
  for (const BadModel& model :
       {BadModel{"half_precision", "half=False"}, BadModel{"exported_opset12", "tools/onnx_for_opencv.py"},
        BadModel{"exported_opset17", "tools/onnx_for_opencv.py"}, BadModel{"split_opset17", "Split"}}) {
    if (kOpencvRunsExports)
      expect_finds_what_is_there(model.name, with(Backend::kOpencv));
    else
      expect_refused(model, with(Backend::kOpencv));
    if (has_openvino()) expect_finds_what_is_there(model.name, with(Backend::kOpenvino));
  }
}

TEST(Backends, GiveTheSameBoxesToATenthOfAPixel) {
  if (!has_openvino()) GTEST_SKIP() << "built without OpenVINO (scripts/openvino.sh)";
  const auto model = source_tree() / "data/models/fiducial.onnx";
  const cv::Mat picture = cv::imread(test_data() / "detection/targets.jpg");
  const auto by_opencv = open_detector({model, {}}, with(Backend::kOpencv))->detect(picture);
  const auto by_openvino = open_detector({model, {}}, with(Backend::kOpenvino))->detect(picture);
  ASSERT_GE(by_opencv.size(), 5U);
  ASSERT_EQ(by_opencv.size(), by_openvino.size());
  for (std::size_t i = 0; i < by_opencv.size(); ++i) {
    const Box &a = by_opencv[i].box, &b = by_openvino[i].box;
    EXPECT_NEAR(a.x, b.x, 0.1);
    EXPECT_NEAR(a.y, b.y, 0.1);
    EXPECT_NEAR(a.width, b.width, 0.1);
    EXPECT_NEAR(a.height, b.height, 0.1);
    EXPECT_NEAR(by_opencv[i].confidence, by_openvino[i].confidence, 1e-3);
  }
}

TEST(Backends, ThatWereNotBuiltInSayHowToGetThem) {
  if (has_openvino()) GTEST_SKIP() << "built with OpenVINO";
  EXPECT_NE(fault_of({fixture("plain"), {}}, with(Backend::kOpenvino)).find("scripts/openvino.sh"),
            std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
