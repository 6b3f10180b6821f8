// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/second_look.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

#include "fixtures.hpp"

// The networks are described in tools/fixtures/make_onnx_fixtures.py: the second look's score is how red the
// middle of its patch is; its other outputs never change.
namespace geoloc::io {
namespace {

const cv::Scalar kGrey = cv::Scalar::all(114);

/// Proposes the same boxes in every picture.
class Proposer final : public Detector {
 public:
  explicit Proposer(std::vector<Box> boxes) : boxes_(std::move(boxes)) {}

  std::vector<Detection> detect(const cv::Mat& bgr) override {
    std::vector<Detection> detections;
    for (const Box& box : boxes_) {
      if (!bgr.empty()) detections.push_back({box, 0.1, 0});
    }
    return detections;
  }
  const std::vector<std::string>& class_names() const override { return names_; }
  DetectorCounts counts() const override { return {}; }

 private:
  std::vector<Box> boxes_;
  std::vector<std::string> names_{"thing"};
};

SecondLookDetector looking_at(const std::vector<Box>& boxes, const std::string& network = "second_look",
                              const DetectionConfig& config = {}) {
  return SecondLookDetector{std::make_unique<Proposer>(boxes), fixture(network), config};
}

cv::Mat with_red(const cv::Size& size, const cv::Rect& where) {
  cv::Mat picture{size, CV_8UC3, kGrey};
  picture(where).setTo(kRed);
  return picture;
}

class OnEachBackend : public ::testing::TestWithParam<Backend> {};

INSTANTIATE_TEST_SUITE_P(SecondLook, OnEachBackend, ::testing::ValuesIn(backends()), backend_name);

TEST_P(OnEachBackend, MovesSizesAndJudgesABoxByItsSurroundings) {
  DetectionConfig config;
  config.backend = GetParam();
  const Box box{44, 34, 24, 12};  // around (56, 40): the patch is 48 px from (32, 16) on
  auto detector = looking_at({box}, "second_look", config);
  const auto found = detector.detect(with_red({192, 64}, {48, 32, 16, 16}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.x + 0.5 * found[0].box.width, 32 + 0.6 * 48, 1e-4);
  EXPECT_NEAR(found[0].box.y + 0.5 * found[0].box.height, 16 + 0.55 * 48, 1e-4);
  EXPECT_NEAR(found[0].box.width, 24, 1e-4);
  EXPECT_NEAR(found[0].box.height, 12, 1e-4);
  EXPECT_NEAR(found[0].sigma_px, 0.02 * 48, 1e-5);
  EXPECT_GT(found[0].confidence, 0.99);
  EXPECT_TRUE(detector.detect(with_red({192, 64}, {0, 0, 16, 16})).empty());
}

TEST(SecondLook, LooksAtWhatIsInDoubtMirroredToo) {
  // The patch of 48 px is seen as 8 x 8 blocks, its block (4, 4) plain, (3, 4) reversed, (4, 3) upside down.
  cv::Mat patch{8, 8, CV_8UC3, kGrey};
  patch.at<cv::Vec3b>(4, 4) = {90, 90, 160};
  patch.at<cv::Vec3b>(4, 3) = {60, 120, 220};
  patch.at<cv::Vec3b>(3, 4) = {114, 130, 140};
  for (int column = 0; column < 8; ++column) patch.at<cv::Vec3b>(0, column) = {20, 30, 200};
  cv::Mat picture{64, 192, CV_8UC3, kGrey};
  cv::resize(patch, picture(cv::Rect{32, 16, 48, 48}), {48, 48}, 0, 0, cv::INTER_NEAREST);

  double red_sum = 0.0, luma_sum = 0.0, luma_squares = 0.0;
  for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(patch)) {
    const double luma = 0.114 * pixel[0] + 0.587 * pixel[1] + 0.299 * pixel[2];
    red_sum += pixel[2];
    luma_sum += luma;
    luma_squares += luma * luma;
  }
  const double contrast = std::sqrt(luma_squares / 64 - std::pow(luma_sum / 64, 2));
  const auto logit = [&](int row, int column) {
    return (patch.at<cv::Vec3b>(row, column)[2] - red_sum / 64) / contrast;
  };
  const double mean_logit = (logit(4, 4) + logit(4, 3) + logit(3, 4)) / 3;

  DetectionConfig config;
  config.confidence = 1e-6;
  const auto found = looking_at({{44, 34, 24, 12}}, "second_look", config).detect(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(std::abs(mean_logit - logit(4, 4)), 0.1);  // it makes a difference
  EXPECT_NEAR(found[0].confidence, 1 / (1 + std::exp(-mean_logit)), 1e-4);
  EXPECT_NEAR(found[0].box.x + 0.5 * found[0].box.width, 32 + (0.5 + (0.1 - 0.1 + 0.1) / 3) * 48, 1e-4);
  EXPECT_NEAR(found[0].box.y + 0.5 * found[0].box.height, 16 + (0.5 + (0.05 + 0.05 - 0.05) / 3) * 48, 1e-4);
}

TEST(SecondLook, TellsTheSameOfABoxWhateverElseItLooksAt) {
  std::mt19937 random{3};
  std::uniform_real_distribution<double> size{4.0, 30.0};
  cv::Mat picture(90, 400, CV_8UC3);
  cv::randu(picture, cv::Scalar::all(0), cv::Scalar::all(256));
  std::vector<Box> boxes;
  for (int i = 0; i < 9; ++i) boxes.push_back({40.0 * i + 5.0, size(random), size(random), size(random)});
  DetectionConfig config;
  config.confidence = 1e-6;
  config.nms_iou = 1.0;
  const auto all = looking_at(boxes, "second_look", config).detect(picture);
  std::size_t alone = 0;
  for (const Box& box : boxes) {
    for (const Detection& one : looking_at({box}, "second_look", config).detect(picture)) {
      ++alone;
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Detection& other) {
        return other.box.x == one.box.x && other.box.y == one.box.y && other.confidence == one.confidence;
      }));
    }
  }
  EXPECT_GE(alone, 3U);
  EXPECT_EQ(all.size(), alone);
}

TEST(SecondLook, JudgesAlikeInAnyLight) {
  const Box box{44, 34, 24, 12};
  DetectionConfig config;
  config.confidence = 1e-6;
  cv::Mat picture = with_red({192, 64}, {30, 20, 60, 40});  // not so red that the score would saturate
  picture(cv::Rect{40, 20, 10, 40}).setTo(cv::Scalar{0, 0, 200});
  auto detector = looking_at({box}, "second_look", config);
  const auto bright = detector.detect(picture);
  ASSERT_EQ(bright.size(), 1U);
  ASSERT_LT(bright[0].confidence, 0.95);
  cv::Mat dim;
  picture.convertTo(dim, -1, 0.3, 20.0);
  const auto dark = detector.detect(dim);
  ASSERT_EQ(dark.size(), 1U);
  EXPECT_NEAR(dark[0].confidence, bright[0].confidence, 0.02);
}

TEST(SecondLook, TakesBoxesAtEveryEdgeOfPicturesOfAnySize) {
  for (const cv::Size size : {cv::Size{1, 1}, {1, 300}, {300, 1}, {17, 23}, {1280, 720}}) {
    const double width = size.width, height = size.height;
    auto detector = looking_at({{0, 0, 1, 1},
                                {width - 1, height - 1, 1, 1},
                                {0, 0, width, height},
                                {0.5 * width, 0, 0.5 * width, 1e-3},
                                {width - 1e-9, 0, 1e-9, height}});
    for (const Detection& found : detector.detect(cv::Mat{size, CV_8UC3, kRed})) {
      EXPECT_GE(found.box.x, 0.0);
      EXPECT_LE(found.box.x + found.box.width, width);
    }
    EXPECT_EQ(detector.counts().failed_images, 0U);
  }
}

TEST(SecondLook, StatesNoSigmaOfABoxThatThePictureCuts) {
  auto detector = looking_at({{0, 20, 24, 24}});  // the box is moved beyond the lower edge, not the left one
  const auto found = detector.detect(cv::Mat{48, 192, CV_8UC3, kGrey});
  EXPECT_TRUE(found.empty());
  auto at_edge = looking_at({{180, 20, 12, 12}});
  cv::Mat picture{64, 192, CV_8UC3, kGrey};
  picture(cv::Rect{184, 20, 8, 12}).setTo(kRed);
  const auto cut = at_edge.detect(picture);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut[0].sigma_px, 0.0);
}

TEST(SecondLook, RejectsAndCountsAnswersThatCannotBe) {
  auto detector = looking_at({{44, 34, 24, 12}}, "second_look_flat");
  EXPECT_TRUE(detector.detect(with_red({192, 64}, {48, 32, 16, 16})).empty());
  EXPECT_EQ(detector.counts().rejected_boxes, 1U);
}

TEST(SecondLook, IsTheOneThatTheModelNamesOrTheUser) {
  const cv::Mat picture = with_red({192, 64}, {48, 32, 16, 16});
  const auto sigma_of = [&](const DetectorFiles& files) {
    const auto found = open_detector(files, {})->detect(picture);
    return found.size() == 1 ? found[0].sigma_px : -1.0;
  };
  EXPECT_NEAR(sigma_of({fixture("looks_twice"), {}}), 0.02 * 48, 1e-5);
  EXPECT_NEAR(sigma_of({fixture("plain"), {}, fixture("second_look")}), 0.02 * 48, 1e-5);
  EXPECT_EQ(sigma_of({fixture("looks_twice"), {}, std::filesystem::path{}}), 0.0);
  EXPECT_EQ(sigma_of({fixture("plain"), {}}), 0.0);
}

void expect_refused(const DetectorFiles& files, const std::string& says) {
  try {
    open_detector(files, {});
    FAIL() << says;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string{error.what()}.find(says), std::string::npos) << error.what();
  }
}

TEST(SecondLook, IsRefusedWithItsNameTheFaultAndTheRemedy) {
  expect_refused({fixture("looks_for_the_lost"), {}}, "needs lost.onnx beside it");
  expect_refused({fixture("looks_elsewhere"), {}}, "no file's name without a folder");
  expect_refused({fixture("plain"), {}, fixture("none")}, "none.onnx: cannot be read");
  expect_refused({fixture("plain"), {}, fixture("second_look_five")},
                 "[2, 5]; that of a second look is [2, 6]");
  for (const char* network : {"second_look_oblong", "second_look_open", "plain"})
    expect_refused({fixture("plain"), {}, fixture(network)},
                   "that of a second look is [batch, 3, side, side]");
}

TEST(SecondLook, HasItsLimits) {
  DetectionConfig config;
  config.second_look = {0.0, 0};
  EXPECT_EQ(config.problems().size(), 2U);
  EXPECT_EQ(proposing({}).confidence, SecondLookConfig{}.confidence);
  EXPECT_EQ(proposing({}).max_detections, SecondLookConfig{}.max_boxes);
}

}  // namespace
}  // namespace geoloc::io
