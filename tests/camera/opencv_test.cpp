// SPDX-License-Identifier: Apache-2.0
// OpenCV itself as the oracle, where it is installed.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "camera/lenses.hpp"

namespace geoloc {
namespace {

class CameraAgainstOpenCv : public ::testing::TestWithParam<Lens> {};

TEST_P(CameraAgainstOpenCv, PixelIsOpenCvsProjectPoints) {
  const CameraIntrinsics k = camera_with(GetParam().distortion);
  const CameraModel camera(k);
  const cv::Matx33d matrix(k.fx_px, 0, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1);
  const std::vector<double> distortion(k.distortion.begin(), k.distortion.end());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-12, 12), y(-7, 7), z(18, 80);
  for (int i = 0; i < 500; ++i) {
    const cv::Point3d point(x(random), y(random), z(random));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{point}, cv::Vec3d(), cv::Vec3d(), matrix, distortion,
                      expected);
    const auto pixel = camera.pixel({point.x, point.y, point.z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, CameraAgainstOpenCv, every_lens(), lens_name);

}  // namespace
}  // namespace geoloc
