// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/camera_renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "geoloc/geometry/attitude.hpp"
#include "sim/world/drawn_object.hpp"

namespace geoloc::sim {
namespace {

struct View {
  const char* name;
  double roll_deg;
  double pitch_deg;
  double yaw_deg;
  Eigen::Vector2d position_in_enu;
};

class DrawnPlaces : public ::testing::TestWithParam<View> {};

/// A white panel: all of it differs from asphalt by about as much, so its centre of mass is its centre.
PlacedObject panel_at(const Eigen::Vector2d& position_in_enu) {
  PlacedObject panel;
  panel.kind = ObjectKind::kWhitePanel;
  panel.position_in_enu = position_in_enu;
  panel.heading_rad = 0.4;
  panel.size_m = 0.4;
  return panel;
}

TEST_P(DrawnPlaces, AreThoseOfTheCameraModel) {
  const View view = GetParam();
  const Rigid3d enu_from_camera = pose_above(20.0, view.roll_deg, view.pitch_deg, view.yaw_deg);
  const CameraModel camera(barrel_camera());
  const Eigen::Vector3d place{view.position_in_enu.x(), view.position_in_enu.y(), 0.0};
  const auto expected = camera.pixel(enu_from_camera.inverse() * place);
  ASSERT_TRUE(expected);
  const cv::Mat drawn = drawn_object(barrel_camera(), panel_at(view.position_in_enu), enu_from_camera);
  ASSERT_GT(cv::sum(drawn)[0], 1000.0);
  EXPECT_LT((centre_of_mass(drawn) - *expected).norm(), 0.3) << centre_of_mass(drawn).transpose();
}

INSTANTIATE_TEST_SUITE_P(Views, DrawnPlaces,
                         ::testing::Values(View{"below", 0, 0, 0, {0.3, -0.2}},
                                           View{"in_the_corner", 0, 0, 90, {6.0, -10.5}},
                                           View{"rolled", 25, 0, 45, {-4.0, 4.0}},
                                           View{"pitched", 0, 30, 200, {-3.0, -8.0}},
                                           View{"both", -20, 20, -120, {-10.0, -6.0}}),
                         [](const auto& view) { return std::string(view.param.name); });

TEST(CameraRenderer, MotionBlurMovesNothing) {
  const Rigid3d enu_from_camera = pose_above(20.0, 5.0, 5.0, 30.0);
  const cv::Mat sharp = drawn_object(barrel_camera(), panel_at({1.0, 1.0}), enu_from_camera);
  const cv::Mat blurred = drawn_object(barrel_camera(), panel_at({1.0, 1.0}), enu_from_camera, {9.0, -4.0});
  EXPECT_LT((centre_of_mass(sharp) - centre_of_mass(blurred)).norm(), 0.1);
  EXPECT_GT(cv::countNonZero(blurred > 5.0), cv::countNonZero(sharp > 5.0));
}

cv::Mat picture(std::uint64_t noise_seed, std::uint64_t ground_seed, const Rigid3d& enu_from_camera) {
  Scene scene;
  scene.ground_seed = ground_seed;
  scene.objects = {PlacedObject{}};
  RenderSettings settings;
  settings.seed = noise_seed;
  cv::Mat bgr;
  CameraRenderer(CameraIntrinsics{}, scene, settings).render(enu_from_camera, {1.0, 0.0}, bgr);
  return bgr;
}

TEST(CameraRenderer, TheSameSeedsGiveTheSamePicture) {
  const Rigid3d above = pose_above(20.0, 0.0, 0.0, 0.0);
  const cv::Mat first = picture(1, 1, above);
  EXPECT_EQ(cv::norm(first, picture(1, 1, above), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, picture(2, 1, above), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, picture(1, 2, above), cv::NORM_INF), 0.0);
}

TEST(CameraRenderer, TheSkyEndsAtTheHorizon) {
  // Pitched up by 90 deg, a camera that is mounted looking down looks at the horizon: it lies on the middle
  // row.
  const cv::Mat level = picture(1, 1, pose_above(20.0, 0.0, 90.0, 0.0));
  const cv::Scalar sky = cv::mean(level.rowRange(0, 100)), ground = cv::mean(level.rowRange(620, 720));
  EXPECT_GT(sky[0], sky[2] + 20.0) << "the sky is blue";
  EXPECT_LT(cv::sum(ground)[0], cv::sum(sky)[0] - 100.0);
  const cv::Mat upside_down = picture(1, 1, pose_above(20.0, 180.0, 0.0, 0.0));
  const cv::Scalar all_sky = cv::mean(upside_down);
  EXPECT_GT(all_sky[0], all_sky[2] + 20.0);
}

TEST(CameraRenderer, DarkensWhatLiesInAShadowAndNothingElse) {
  Scene scene;
  scene.objects = {PlacedObject{}};  // at (0, 0), in the middle of the picture
  RenderSettings settings;
  settings.noise_sigma = 0.0;
  const auto render = [&] {
    cv::Mat bgr;
    CameraRenderer(CameraIntrinsics{}, scene, settings).render(pose_above(20.0, 0.0, 0.0, 0.0), {0, 0}, bgr);
    return bgr;
  };
  const cv::Mat lit = render();
  Shadow western;
  western.outline_in_enu = {{-2.0, -2.0}, {-2.0, 2.0}, {0.0, 2.0}, {0.0, -2.0}};
  western.darkness = 0.5;
  scene.shadows = {western};
  const cv::Mat shaded = render();
  const cv::Rect west(600, 340, 36, 40), east(644, 340, 36, 40);  // of the middle: target and ground
  EXPECT_NEAR(cv::mean(shaded(west))[1] / cv::mean(lit(west))[1], 0.5, 0.02);
  EXPECT_EQ(cv::norm(shaded(east), lit(east), cv::NORM_INF), 0.0);

  scene.shadows[0].outline_in_enu[0] = {std::numeric_limits<double>::infinity(), 0.0};
  EXPECT_EQ(cv::norm(render(), lit, cv::NORM_INF), 0.0);
}

TEST(CameraRenderer, SurvivesAnyPose) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Rigid3d above = pose_above(20.0, 10.0, 10.0, 0.0);
  CameraRenderer renderer(barrel_camera(), Scene{{PlacedObject{}}, GroundStyle::kSand, 3, {}});
  cv::Mat bgr;
  for (const double height_m : {-20.0, 0.0, 1e-9, 0.01, 1e4, 1e12, kNan, kInfinity}) {
    for (const double east_m : {0.0, 1e7, -1e15, kNan}) {
      const Rigid3d pose{above.rotation, {east_m, 0.0, height_m}};
      renderer.render(pose, {kNan, 1.0}, bgr);
      renderer.render(pose, {1e300, -1e300}, bgr);
    }
  }
  renderer.render({Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 20}}, {0, 0}, bgr);
  renderer.render({Eigen::Quaterniond(kNan, 0, 0, 1), {0, 0, 20}}, {0, 0}, bgr);
  EXPECT_EQ(bgr.size(), cv::Size(1280, 720));
  EXPECT_EQ(bgr.type(), CV_8UC3);
}

TEST(CameraRenderer, DrawsIntoThePictureItIsGiven) {
  CameraRenderer renderer(CameraIntrinsics{}, Scene{});
  cv::Mat bgr(720, 1280, CV_8UC3);
  const unsigned char* const pixels = bgr.data;
  renderer.render(pose_above(20.0, 0.0, 0.0, 0.0), {0.0, 0.0}, bgr);
  EXPECT_EQ(bgr.data, pixels);
}

TEST(CameraRenderer, NamesEveryFaultOfItsSettings) {
  RenderSettings settings;
  settings.exposure = 0.0;
  settings.noise_sigma = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(settings.problems().size(), 2u);
  EXPECT_THROW(CameraRenderer(CameraIntrinsics{}, Scene{}, settings), std::invalid_argument);
}

TEST(ImageMotion, IsThatOfTheGroundInTheMiddle) {
  const CameraModel camera{CameraIntrinsics{}};
  const Rigid3d before = pose_above(20.0, 0.0, 0.0, 0.0);
  Rigid3d after = before;
  after.translation.y() += 0.2;  // northwards, which is up in the picture: the ground moves down
  const Eigen::Vector2d motion_px = image_motion_px(camera, before, after);
  EXPECT_NEAR(motion_px.x(), 0.0, 1e-6);
  EXPECT_NEAR(motion_px.y(), 0.2 / 20.0 * camera.intrinsics().fy_px, 1e-6);
  EXPECT_EQ(image_motion_px(camera, pose_above(20.0, 180.0, 0.0, 0.0), after),
            Eigen::Vector2d::Zero().eval());
}

}  // namespace
}  // namespace geoloc::sim
