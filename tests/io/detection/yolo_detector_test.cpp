// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/opencv_detector.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "support/temporary_folder.hpp"

// The networks are described in tools/fixtures/make_onnx_fixtures.py: what they find is known in closed form.
namespace geoloc::io {
namespace {

const cv::Scalar kRed{0, 0, 255};
const cv::Scalar kBlue{255, 0, 0};

std::filesystem::path fixture(const std::string& name) {
  return std::filesystem::path{GEOLOC_TEST_DATA_DIR} / "onnx" / (name + ".onnx");
}

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

std::string fault_of(const std::filesystem::path& file,
                     const std::optional<std::filesystem::path>& names = {}) {
  try {
    const OpencvDetector detector{{file, names}, {}};
    return "none";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

class EveryGoodModel : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryGoodModel, FindsWhatIsThereWhereItIs) {
  OpencvDetector detector{{fixture(GetParam()), {}}, {}};
  EXPECT_EQ(detector.input_size().width_px, 96);
  EXPECT_EQ(detector.input_size().height_px, 64);
  expect_cell(detector.detect(picture_with_cell(3, 2, kRed)), 3, 2, 0);
  expect_cell(detector.detect(picture_with_cell(9, 1, kBlue)), 9, 1, 1);
  EXPECT_TRUE(detector.detect(cv::Mat{64, 192, CV_8UC3, cv::Scalar::all(255)}).empty());
  EXPECT_EQ(detector.counts().images, 3U);
  EXPECT_EQ(detector.counts().failed_images, 0U);
}

INSTANTIATE_TEST_SUITE_P(Fixtures, EveryGoodModel,
                         ::testing::Values("plain", "unnamed", "constants_as_inputs", "converted_opset12",
                                           "converted_opset17"),
                         [](const auto& instance) { return std::string{instance.param}; });

TEST(OpencvDetector, KeepsNothingOfAPictureOfAnotherShape) {
  OpencvDetector detector{{fixture("plain"), {}}, {}};
  ASSERT_EQ(detector.detect(cv::Mat{128, 192, CV_8UC3, kRed}).size(), 96U);
  EXPECT_TRUE(detector.detect(cv::Mat{10, 192, CV_8UC3, cv::Scalar::all(0)}).empty());
  EXPECT_TRUE(detector.detect(cv::Mat{400, 3, CV_8UC3, cv::Scalar::all(0)}).empty());
}

TEST(OpencvDetector, TakesGreyAndTransparentPicturesAndPartsOfPictures) {
  OpencvDetector detector{{fixture("plain"), {}}, {}};
  cv::Mat transparent;
  cv::cvtColor(picture_with_cell(3, 2, kRed), transparent, cv::COLOR_BGR2BGRA);
  expect_cell(detector.detect(transparent), 3, 2, 0);
  EXPECT_TRUE(detector.detect(cv::Mat{64, 192, CV_8UC1, cv::Scalar{200}}).empty());

  cv::Mat larger{100, 300, CV_8UC3, kBlue};
  picture_with_cell(3, 2, kRed).copyTo(larger(cv::Rect{50, 20, 192, 64}));
  expect_cell(detector.detect(larger(cv::Rect{50, 20, 192, 64})), 3, 2, 0);
  EXPECT_EQ(detector.counts().unusable_images, 0U);
}

TEST(OpencvDetector, CountsWhatIsNoPicture) {
  OpencvDetector detector{{fixture("plain"), {}}, {}};
  const int cube[] = {4, 4, 4};
  for (const cv::Mat& picture :
       {cv::Mat{}, cv::Mat{64, 192, CV_16UC3, kRed}, cv::Mat{64, 192, CV_32FC3, kRed},
        cv::Mat{64, 192, CV_8UC2, kRed}, cv::Mat{3, cube, CV_8UC3, kRed}}) {
    EXPECT_TRUE(detector.detect(picture).empty());
  }
  EXPECT_EQ(detector.counts().images, 5U);
  EXPECT_EQ(detector.counts().unusable_images, 5U);
}

TEST(OpencvDetector, TakesItsClassNamesFromTheModelOrAFile) {
  using Names = std::vector<std::string>;
  EXPECT_EQ((OpencvDetector{{fixture("plain"), {}}, {}}.class_names()), (Names{"red", "driver's blue"}));
  EXPECT_EQ((OpencvDetector{{fixture("unnamed"), {}}, {}}.class_names()), (Names{"class 0", "class 1"}));

  const testing::TemporaryFolder folder;
  const auto two_names = folder.write("two.txt", "rouge\r\nbleu\n\n");
  EXPECT_EQ((OpencvDetector{{fixture("plain"), two_names}, {}}.class_names()), (Names{"rouge", "bleu"}));
  EXPECT_NE(fault_of(fixture("plain"), folder.write("one.txt", "name\n")).find("has 1 names"),
            std::string::npos);
  EXPECT_NE(fault_of(fixture("plain"), folder.path() / "none.txt").find("cannot be read"), std::string::npos);
}

struct BadModel {
  const char* name;
  const char* says;
};

class EveryBadModel : public ::testing::TestWithParam<BadModel> {};

TEST_P(EveryBadModel, IsRefusedWithItsNameTheFaultAndTheRemedy) {
  const std::string fault = fault_of(fixture(GetParam().name));
  EXPECT_NE(fault.find(fixture(GetParam().name).string()), std::string::npos) << fault;
  EXPECT_NE(fault.find(GetParam().says), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(Fixtures, EveryBadModel,
                         ::testing::Values(BadModel{"no_such_file", "cannot be read"},
                                           BadModel{"dynamic_size", "[1, 3, ?, ?]"},
                                           BadModel{"dynamic_batch", "dynamic=False batch=1"},
                                           BadModel{"transposed", "[1, 96, 6], not [1, 6, candidates]"},
                                           BadModel{"too_many_names", "not [1, 7, candidates]"},
                                           BadModel{"two_outputs", "has 2 outputs"},
                                           BadModel{"half_precision", "half=False"},
                                           BadModel{"exported_opset12", "tools/onnx_for_opencv.py"},
                                           BadModel{"exported_opset17", "tools/onnx_for_opencv.py"},
                                           BadModel{"split_opset17", "Split"}),
                         [](const auto& instance) { return std::string{instance.param.name}; });

TEST(OpencvDetector, RefusesFilesThatAreNoModels) {
  const testing::TemporaryFolder folder;
  for (const std::string& content :
       {std::string{}, std::string{"not a model\n"}, std::string(5000, '\xff')}) {
    const auto file = folder.write("model.onnx", content);
    EXPECT_NE(fault_of(file).find(file.string()), std::string::npos);
  }
  EXPECT_NE(fault_of(folder.path()).find("cannot be read"), std::string::npos);
}

TEST(OpencvDetector, RefusesABadConfiguration) {
  DetectionConfig config;
  config.confidence = 2;
  EXPECT_THROW(OpencvDetector({fixture("plain"), {}}, config), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::io
