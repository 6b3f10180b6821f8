// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/labelled_images.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

namespace geoloc::sim {
namespace {

namespace fs = std::filesystem;

class LabelledImages : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("geoloc_images_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ostringstream all;
    all << std::ifstream(file, std::ios::binary).rdbuf();
    return all.str();
  }

  fs::path folder_;
};

const auto kGoOn = [](int) { return true; };

TEST_F(LabelledImages, AreTheSameForTheSameSeed) {
  ASSERT_TRUE(write_labelled_images({2, 3}, folder_ / "a", kGoOn));
  ASSERT_TRUE(write_labelled_images({2, 3}, folder_ / "b", kGoOn));
  for (const char* const file :
       {"images/00000.jpg", "images/00001.jpg", "labels/00000.txt", "labels/00001.txt"}) {
    ASSERT_TRUE(fs::exists(folder_ / "a" / file));
    EXPECT_EQ(content(folder_ / "a" / file), content(folder_ / "b" / file)) << file;
  }
}

TEST_F(LabelledImages, CarryTheLabelsOfTheirShots) {
  ASSERT_TRUE(write_labelled_images({1, 4}, folder_ / "set", kGoOn));
  const auto labels = labels_of(random_shot(4, 0));
  std::ifstream file(folder_ / "set/labels/00000.txt");
  for (const VisibleBox& label : labels) {
    int class_id = -1;
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    ASSERT_TRUE(file >> class_id >> x >> y >> width >> height);
    EXPECT_EQ(class_id, 0);
    EXPECT_NEAR(x * 1280.0, label.centre_px.x() + 0.5, 1e-2);
    EXPECT_NEAR(y * 720.0, label.centre_px.y() + 0.5, 1e-2);
    EXPECT_NEAR(width * 1280.0, label.whole.width, 1e-2);
    EXPECT_NEAR(height * 720.0, label.whole.height, 1e-2);
  }
  std::string rest;
  EXPECT_FALSE(file >> rest);
}

TEST_F(LabelledImages, ListEveryObjectInView) {
  ASSERT_TRUE(write_labelled_images({1, 4}, folder_ / "set", kGoOn));
  const Shot shot = random_shot(4, 0);
  const CameraModel camera(shot.intrinsics);
  std::ifstream file(folder_ / "set/objects.csv");
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "picture,kind,centre_x_px,centre_y_px,width_px,height_px,visible_fraction,tilt_deg");
  for (std::size_t index = 0; index < shot.scene.objects.size(); ++index) {
    const auto box = visible_box(camera, shot.enu_from_camera, shot.scene.objects, index);
    if (!box) continue;
    ASSERT_TRUE(std::getline(file, line));
    const bool is_target = shot.scene.objects[index].kind == ObjectKind::kFiducial;
    EXPECT_EQ(line.rfind("00000,target,", 0) == 0, is_target) << line;
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST_F(LabelledImages, AreTheSameWithCrispOnesBesideThem) {
  ASSERT_TRUE(write_labelled_images({1, 4}, folder_ / "plain", kGoOn));
  ASSERT_TRUE(write_labelled_images({1, 4, {}, true}, folder_ / "set", kGoOn));
  EXPECT_EQ(content(folder_ / "plain/images/00000.jpg"), content(folder_ / "set/images/00000.jpg"));
  const cv::Mat picture = cv::imread(folder_ / "set/images/00000.jpg", cv::IMREAD_GRAYSCALE);
  const cv::Mat crisp = cv::imread(folder_ / "set/crisp/00000.png", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(crisp.size(), picture.size());
  ASSERT_EQ(crisp.type(), CV_8UC1);
  cv::Mat correlation;
  cv::matchTemplate(picture, crisp, correlation, cv::TM_CCOEFF_NORMED);
  EXPECT_GT(correlation.at<float>(0, 0), 0.8F);
  EXPECT_FALSE(fs::exists(folder_ / "plain/crisp"));
}

TEST_F(LabelledImages, LeaveNothingBehindWhenInterrupted) {
  EXPECT_FALSE(write_labelled_images({5, 1}, folder_ / "set", [](int done) { return done < 1; }));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(LabelledImages, NeverTouchAFolderThatExists) {
  fs::create_directory(folder_ / "set");
  EXPECT_THROW(write_labelled_images({1, 1}, folder_ / "set", kGoOn), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder_ / "set"));
}

TEST(RandomShots, VaryAsTheDetectorNeeds) {
  int labels = 0, small = 0, large = 0, without_target = 0, steep = 0, shadows = 0;
  constexpr int kShots = 300;
  for (int index = 0; index < kShots; ++index) {
    const Shot shot = random_shot(9, index);
    const Eigen::Vector3d optical_axis = shot.enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_GE(-optical_axis.z(), std::cos(60.1 * M_PI / 180.0));
    steep += -optical_axis.z() < std::cos(40.0 * M_PI / 180.0) ? 1 : 0;
    shadows += shot.scene.shadows.empty() ? 0 : 1;
    const auto boxes = labels_of(shot);
    without_target += boxes.empty() ? 1 : 0;
    for (const VisibleBox& label : boxes) {
      EXPECT_GE(label.visible_fraction, kLabelledFraction);
      const double size_px = std::sqrt(label.whole.width * label.whole.height);
      small += size_px >= 8.0 && size_px <= 20.0 ? 1 : 0;
      large += size_px >= 60.0 && size_px <= 250.0 ? 1 : 0;
      ++labels;
    }
  }
  EXPECT_GT(labels, 2 * kShots);
  EXPECT_GT(small, labels / 10);
  EXPECT_GT(large, labels / 10);
  EXPECT_GT(steep, kShots / 10);
  EXPECT_GT(shadows, kShots / 5);
  EXPECT_GT(without_target, kShots / 20);
}

TEST(RandomShots, AreTakenFromTheDistancesAskedFor) {
  for (int index = 0; index < 50; ++index) {
    const Shot shot = random_shot(9, index, {ImageSet::kTraining, {40.0, 60.0}});
    const Eigen::Vector3d optical_axis = shot.enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
    const double range_m = -shot.enu_from_camera.translation.z() / optical_axis.z();
    EXPECT_GE(range_m, 40.0 - 1e-9);
    EXPECT_LE(range_m, 60.0 + 1e-9);
  }
}

TEST(RandomShots, ShareNeitherGroundNorLightBetweenTheSets) {
  std::array<std::array<int, kGroundStyleCount>, 2> grounds{};
  for (int index = 0; index < 300; ++index) {
    for (const ImageSet set : {ImageSet::kTraining, ImageSet::kHeldBack}) {
      const Shot shot = random_shot(9, index, {set});
      ++grounds[set == ImageSet::kTraining ? 0 : 1][static_cast<std::size_t>(shot.scene.ground)];
      const bool usual_exposure = shot.settings.exposure >= 0.5 && shot.settings.exposure <= 1.5;
      EXPECT_EQ(usual_exposure, set == ImageSet::kTraining) << shot.settings.exposure;
    }
  }
  for (std::size_t style = 0; style < grounds[0].size(); ++style) {
    EXPECT_TRUE((grounds[0][style] == 0) != (grounds[1][style] == 0)) << style;
  }
}

}  // namespace
}  // namespace geoloc::sim
