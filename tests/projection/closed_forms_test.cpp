// SPDX-License-Identifier: Apache-2.0
// Rays against the ground plane by hand, with a pinhole whose focal length is 1000 px across and 800 px down.
#include <gtest/gtest.h>

#include <limits>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"
#include "projection/camera_pose.hpp"

namespace geoloc {
namespace {

const CameraIntrinsics kPinhole{1280, 720, 1000.0, 800.0, 640.0, 360.0, {}};

/// A level vehicle whose nose points along `yaw_deg`, its camera turned down by `depression_deg`.
Rigid3d looking(double depression_deg, double yaw_deg, const Eigen::Vector3d& position) {
  VehicleState state{};
  state.enu_from_body = {enu_from_ned() * ned_from_body({0.0, 0.0, yaw_deg * kRadPerDeg}), position};
  return enu_from_camera(state, {0.0, -depression_deg, 0.0, 0.0, 0.0, 0.0}, CameraOrientation::kComposed);
}

void expect_near(const Eigen::MatrixXd& value, const Eigen::MatrixXd& expected) {
  EXPECT_LT((value - expected).norm(), 1e-9) << value << "\nnot\n" << expected;
}

TEST(ProjectorByHand, StraightDownScalesByHeightOverFocalLength) {
  ProjectorConfig config;
  config.ground_height_above_home_m = 5.0;
  const Projector projector(config, kPinhole);
  const Rigid3d camera =
      looking(90.0, 0.0, {100.0, -50.0, 25.0});  // 20 m above ground, image top to the north
  const auto fix = projector.project({640.0 + 150.0, 360.0 - 80.0}, camera);
  ASSERT_TRUE(fix);
  expect_near(fix->position_in_enu, Eigen::Vector2d(100.0 + 3.0, -50.0 + 2.0));
  expect_near(fix->ground_from_pixel, Eigen::Vector2d(0.02, -0.025).asDiagonal().toDenseMatrix());
  EXPECT_NEAR(fix->range_m, std::sqrt(20.0 * 20.0 + 3.0 * 3.0 + 2.0 * 2.0), 1e-9);
  expect_near(fix->direction_in_enu, Eigen::Vector3d(3.0, 2.0, -20.0) / fix->range_m);
  expect_near(fix->covariance(2.0), Eigen::Vector2d(0.0016, 0.0025).asDiagonal().toDenseMatrix());
}

TEST(ProjectorByHand, ObliqueCameraMeetsTheGroundAtHeightOverTheTangentOfItsDepression) {
  const Projector projector({}, kPinhole);
  for (const double depression_deg : {20.0, 45.0, 70.0}) {
    const double sine = std::sin(depression_deg * kRadPerDeg),
                 tangent = std::tan(depression_deg * kRadPerDeg);
    const auto fix = projector.project({640.0, 360.0}, looking(depression_deg, 90.0, {0.0, 0.0, 30.0}));
    ASSERT_TRUE(fix);
    expect_near(fix->position_in_enu, Eigen::Vector2d(30.0 / tangent, 0.0));  // to the east
    EXPECT_NEAR(fix->range_m, 30.0 / sine, 1e-9);
    // A pixel to the right moves the fix to the south; one down brings it nearer, stretched once more by the
    // slant.
    expect_near(
        fix->ground_from_pixel,
        (Eigen::Matrix2d() << 0.0, -30.0 / (sine * sine) / 800.0, -30.0 / sine / 1000.0, 0.0).finished());
  }
}

TEST(ProjectorByHand, PixelOffTheAxisAddsToTheDepression) {
  const Projector projector({}, kPinhole);
  const auto fix = projector.project({640.0, 360.0 + 800.0 * std::tan(15.0 * kRadPerDeg)},
                                     looking(30.0, 0.0, {0.0, 0.0, 10.0}));
  ASSERT_TRUE(fix);
  expect_near(fix->position_in_enu, Eigen::Vector2d(0.0, 10.0));  // 45 deg down, to the north
}

/// From 20 m straight down a point that is 4 m up is 16 m away.
TEST(ProjectorByHand, APointAboveTheGroundAppearsFartherFromTheMiddle) {
  const Projector projector({}, kPinhole);
  const Rigid3d camera = looking(90.0, 0.0, {100.0, -50.0, 20.0});
  const auto pixel = [&](double up_m) {
    return *projector.reproject(Eigen::Vector3d(103.2, -48.4, up_m), camera);
  };
  expect_near(pixel(0.0), Eigen::Vector2d(640.0 + 160.0, 360.0 - 64.0));
  expect_near(pixel(4.0), Eigen::Vector2d(640.0 + 200.0, 360.0 - 80.0));
  expect_near(pixel(-12.0), Eigen::Vector2d(640.0 + 100.0, 360.0 - 40.0));
  EXPECT_FALSE(projector.reproject(Eigen::Vector3d(103.2, -48.4, 20.5), camera));
}

TEST(ProjectorByHand, RefusesWhatLiesBeyondEachLimit) {
  ProjectorConfig config;
  config.ground_height_above_home_m = -2.0;
  config.max_range_m = 100.0;
  config.min_depression_deg = 30.0;
  const Projector projector(config, kPinhole);
  const auto refused = [&](double depression_deg, double up_m) -> std::optional<NoFix> {
    const auto fix = projector.project({640.0, 360.0}, looking(depression_deg, 0.0, {0.0, 0.0, up_m}));
    return fix ? std::nullopt : std::optional(fix.error());
  };
  EXPECT_EQ(refused(30.01, 20.0), std::nullopt);
  EXPECT_EQ(refused(29.99, 20.0), NoFix::kTooGrazing);
  EXPECT_EQ(refused(0.01, 20.0), NoFix::kTooGrazing);
  EXPECT_EQ(refused(-0.01, 20.0), NoFix::kAboveHorizon);
  EXPECT_EQ(refused(90.0, 97.99), std::nullopt);
  EXPECT_EQ(refused(90.0, 98.01), NoFix::kTooFar);
  EXPECT_EQ(refused(90.0, -1.99), std::nullopt);
  EXPECT_EQ(refused(90.0, -2.0), NoFix::kBelowGround);
}

TEST(ProjectorByHand, SeesOnlyWhereItWouldAnswer) {
  ProjectorConfig config;
  config.max_range_m = 50.0;
  const Projector projector(config, kPinhole);
  const Rigid3d oblique =
      looking(30.0, 0.0, {0.0, 0.0, 20.0});  // the axis meets the ground at 34.6 m, 40 m away
  EXPECT_TRUE(projector.sees({0.0, 34.6}, oblique, 0.0));
  EXPECT_TRUE(projector.sees({0.0, 45.8}, oblique, 0.0));   // 49.98 m away
  EXPECT_FALSE(projector.sees({0.0, 45.9}, oblique, 0.0));  // 50.07 m away, still in the image
  EXPECT_TRUE(projector.camera().contains(*projector.reproject(Eigen::Vector2d(0.0, 45.9), oblique)));
  EXPECT_FALSE(projector.reproject(Eigen::Vector2d(0.0, -34.6), oblique));  // behind
}

TEST(ProjectorConfig, EachFieldHasItsLimits) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto faults = [](double ground_height_m, double max_range_m, double min_depression_deg) {
    return ProjectorConfig{ground_height_m, max_range_m, min_depression_deg}.problems().size();
  };
  EXPECT_EQ(faults(-10000.0, 1e-9, 1e-9), 0U);
  EXPECT_EQ(faults(10000.0, 100e3, 89.999), 0U);
  EXPECT_EQ(faults(0.0, 100.001e3, 5.0), 1U);
  EXPECT_EQ(faults(0.0, 10.0, 90.0), 1U);
  EXPECT_EQ(faults(-10000.1, 0.0, 0.0), 3U);
  EXPECT_EQ(faults(nan, nan, nan), 3U);
  EXPECT_THROW(Projector({0.0, 0.0, 5.0}, kPinhole), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
