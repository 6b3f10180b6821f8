// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// A camera that looks straight down with its top to the north: right is east, image down is south.
Rigid3d looking_down() {
  const Eigen::Matrix3d rotation = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return {Eigen::Quaterniond(rotation), {3.0, 4.0, 20.0}};
}

/// Where the camera's axis meets the ground.
Eigen::Vector2d aim_point(const Rigid3d& enu_from_camera) {
  const Eigen::Vector3d axis = enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
  return enu_from_camera.translation.head<2>() - enu_from_camera.translation.z() / axis.z() * axis.head<2>();
}

TEST(Calibration, NoneLeavesAPoseAsItIs) {
  Rigid3d pose = looking_down();
  Calibration{}.turn(pose);
  EXPECT_EQ(pose.rotation.coeffs(), looking_down().rotation.coeffs());
  EXPECT_EQ(pose.translation, looking_down().translation);
}

TEST(Calibration, TurnsACameraAboutItsOwnAxes) {
  constexpr double kTurn_rad = 0.1;
  Calibration about_x, about_y, about_z;
  about_x.mean[Index::kBoresight] = kTurn_rad;
  about_y.mean[Index::kBoresight + 1] = kTurn_rad;
  about_z.mean[Index::kBoresight + 2] = kTurn_rad;
  // Right-handed: about its right axis its view rises to the image's top, the north; about its down axis it
  // swings to its right, the east.
  Rigid3d pose = looking_down();
  about_x.turn(pose);
  EXPECT_NEAR(aim_point(pose).x(), 3.0, 1e-12);
  EXPECT_NEAR(aim_point(pose).y(), 4.0 + 20.0 * std::tan(kTurn_rad), 1e-12);
  pose = looking_down();
  about_y.turn(pose);
  EXPECT_NEAR(aim_point(pose).x(), 3.0 + 20.0 * std::tan(kTurn_rad), 1e-12);
  EXPECT_NEAR(aim_point(pose).y(), 4.0, 1e-12);
  // About its line of sight its right axis turns to the image's bottom, the south.
  pose = looking_down();
  about_z.turn(pose);
  const Eigen::Vector3d right = pose.rotation * Eigen::Vector3d::UnitX();
  EXPECT_LT((right - Eigen::Vector3d(std::cos(kTurn_rad), -std::sin(kTurn_rad), 0.0)).norm(), 1e-12);
}

/// Rodrigues' formula, written out.
TEST(Calibration, TurnsAboutAllAxesAtOnceByTheLengthOfTheVector) {
  Calibration calibration;
  const Eigen::Vector3d turn(0.2, -0.3, 0.6);
  calibration.mean.segment<3>(Index::kBoresight) = turn;
  Rigid3d pose = looking_down();
  calibration.turn(pose);
  const double angle = std::sqrt(0.04 + 0.09 + 0.36);
  const Eigen::Vector3d axis = turn / angle;
  for (const Eigen::Vector3d& ray : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.3, -0.2, 1)}) {
    const Eigen::Vector3d cross(axis.y() * ray.z() - axis.z() * ray.y(),
                                axis.z() * ray.x() - axis.x() * ray.z(),
                                axis.x() * ray.y() - axis.y() * ray.x());
    const Eigen::Vector3d turned =
        std::cos(angle) * ray + std::sin(angle) * cross + (1.0 - std::cos(angle)) * axis.dot(ray) * axis;
    EXPECT_LT((pose.rotation * ray - Eigen::Vector3d(turned.x(), -turned.y(), -turned.z())).norm(), 1e-12);
  }
  EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-15);
}

TEST(Calibration, TurnsACameraAndMovesItNowhere) {
  Calibration calibration;
  calibration.mean << 0.1, -0.2, 0.3, 0.5, 1.25, 0.02, 0.04, 7.0, -8.0;
  Rigid3d pose = looking_down();
  calibration.turn(pose);
  EXPECT_EQ(pose.translation, looking_down().translation);
  EXPECT_GT(pose.rotation.angularDistance(looking_down().rotation), 0.3);
}

TEST(Calibration, TurnsBackByItsOpposite) {
  Calibration calibration, opposite;
  calibration.mean << 0.1, -0.2, 0.3, 0.5, 1.25, 0.02, 0.04, 7.0, -8.0;
  opposite.mean = -calibration.mean;
  Rigid3d pose = looking_down();
  calibration.turn(pose);
  opposite.turn(pose);
  EXPECT_LT(pose.rotation.angularDistance(looking_down().rotation), 1e-12);
}

TEST(Calibration, NamesItsComponents) {
  Calibration calibration;
  calibration.mean << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  calibration.covariance.diagonal() << 1, 4, 9, 16, 25, 36, 49, 64, 81;
  EXPECT_EQ(calibration.boresight_rad(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(calibration.latency_s(), 4.0);
  EXPECT_EQ(calibration.height_m(), 5.0);
  EXPECT_EQ(calibration.position_lag_s(), 7.0);
  EXPECT_EQ(calibration.offset_m(), Eigen::Vector2d(8, 9));
  for (int i = 0; i < Index::kSize; ++i) EXPECT_EQ(calibration.sigma(i), i + 1.0);
}

TEST(Calibration, TellsTheFocalLengthAsARatioAndInPercent) {
  Calibration calibration;
  EXPECT_EQ(calibration.focal_ratio(), 1.0);
  EXPECT_EQ(calibration.focal_percent(), 0.0);
  EXPECT_FALSE(calibration.has_unknown_focal());
  calibration.mean[Index::kFocal] = std::log(1.03);
  calibration.covariance(Index::kFocal, Index::kFocal) = 1e-4;
  EXPECT_NEAR(calibration.focal_ratio(), 1.03, 1e-15);
  EXPECT_NEAR(calibration.focal_percent(), 3.0, 1e-12);
  EXPECT_NEAR(calibration.sigma_focal_percent(), 1.03, 1e-12);  // a percent of 103
  EXPECT_TRUE(calibration.has_unknown_focal());
}

}  // namespace
}  // namespace geoloc
