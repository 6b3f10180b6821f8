// SPDX-License-Identifier: Apache-2.0
// The camera model by hand.
#include <gtest/gtest.h>

#include <limits>

#include "geoloc/camera/camera.hpp"

namespace geoloc {
namespace {

CameraIntrinsics round_numbers(const std::array<double, 5>& distortion = {}) {
  return {1280, 720, 1000.0, 800.0, 640.0, 360.0, distortion};
}

TEST(CameraByHand, PinholeDividesByDepth) {
  const CameraModel camera(round_numbers());
  EXPECT_TRUE(camera.pixel({0, 0, 7})->isApprox(Eigen::Vector2d(640, 360), 1e-15));
  EXPECT_TRUE(camera.pixel({1, 2, 10})->isApprox(Eigen::Vector2d(640 + 100, 360 + 160), 1e-15));
  EXPECT_TRUE(camera.pixel({-3, 4, 10})->isApprox(Eigen::Vector2d(640 - 300, 360 + 320), 1e-15));
}

TEST(CameraByHand, PinholeRayIsAffineInThePixel) {
  const CameraModel camera(round_numbers());
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(740, 520), {0, 0}, {-5000, 9000}}) {
    const auto ray = camera.ray(pixel);
    ASSERT_TRUE(ray);
    EXPECT_NEAR(ray->normalized.x(), (pixel.x() - 640) / 1000, 1e-15);
    EXPECT_NEAR(ray->normalized.y(), (pixel.y() - 360) / 800, 1e-15);
    EXPECT_TRUE(
        ray->normalized_from_pixel.isApprox(Eigen::Vector2d(1e-3, 1.25e-3).asDiagonal().toDenseMatrix()));
  }
}

struct Distortion {
  const char* name;
  std::array<double, 5> coefficients;
  Eigen::Vector2d moved;  ///< where (0.5, 0.2) at unit depth goes; r2 = 0.29
};

class DistortionByHand : public ::testing::TestWithParam<Distortion> {};

TEST_P(DistortionByHand, MovesAPointAsItsPolynomialSays) {
  const CameraModel camera(round_numbers(GetParam().coefficients));
  const Eigen::Vector2d expected =
      GetParam().moved.cwiseProduct(Eigen::Vector2d(1000, 800)) + Eigen::Vector2d(640, 360);
  const auto pixel = camera.pixel({1.0, 0.4, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - expected).norm(), 1e-10);
  const auto ray = camera.ray(expected);
  ASSERT_TRUE(ray);
  EXPECT_LT((ray->normalized - Eigen::Vector2d(0.5, 0.2)).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Coefficients, DistortionByHand,
    ::testing::Values(
        Distortion{"k1", {0.1, 0, 0, 0, 0}, {0.5 * 1.029, 0.2 * 1.029}},
        Distortion{"k2", {0, 0.1, 0, 0, 0}, {0.5 * 1.00841, 0.2 * 1.00841}},
        Distortion{"k3", {0, 0, 0, 0, 0.1}, {0.5 * 1.0024389, 0.2 * 1.0024389}},
        Distortion{"p1", {0, 0, 0.1, 0, 0}, {0.5 + 0.1 * 2 * 0.5 * 0.2, 0.2 + 0.1 * (0.29 + 2 * 0.04)}},
        Distortion{"p2", {0, 0, 0, 0.1, 0}, {0.5 + 0.1 * (0.29 + 2 * 0.25), 0.2 + 0.1 * 2 * 0.5 * 0.2}},
        Distortion{"all",
                   {0.1, 0.1, 0.1, 0.1, 0.1},
                   {0.5 * 1.0398489 + 0.02 + 0.079, 0.2 * 1.0398489 + 0.037 + 0.02}}),
    [](const auto& distortion) { return std::string(distortion.param.name); });

struct Fold {
  const char* name;
  std::array<double, 5> coefficients;
  double radius;  ///< where d/dr of r (1 + k1 r^2 + k2 r^4 + k3 r^6) is zero
};

class FoldByHand : public ::testing::TestWithParam<Fold> {};

// The radius is found in steps of 0.01.
TEST_P(FoldByHand, NothingIsSeenBeyondIt) {
  const CameraModel camera(round_numbers(GetParam().coefficients));
  const double radius = GetParam().radius;
  for (const Eigen::Vector2d& direction : {Eigen::Vector2d(1, 0), {-0.6, 0.8}, {0, -1}}) {
    const auto at = [&](double r) { return camera.pixel((r * direction).homogeneous()); };
    EXPECT_TRUE(at(radius - 0.011));
    EXPECT_FALSE(at(radius + 0.001));
    EXPECT_FALSE(at(3.0 * radius));  // even where the model grows again
    const auto inside = at(radius - 0.03);
    ASSERT_TRUE(inside);
    const auto ray = camera.ray(*inside);
    ASSERT_TRUE(ray);
    EXPECT_LT((ray->normalized - (radius - 0.03) * direction).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Coefficients, FoldByHand,
    ::testing::Values(Fold{"k1", {-0.24, 0, 0, 0, 0}, 1.178511},        // (3 0.24)^(-1/2)
                      Fold{"k2", {0, -0.05, 0, 0, 0}, 1.414214},        // (5 0.05)^(-1/4)
                      Fold{"k3", {0, 0, 0, 0, -0.01}, 1.557699},        // (7 0.01)^(-1/6)
                      Fold{"k1_k2", {-0.5, 0.05, 0, 0, 0}, 0.874032}),  // r2 = 3 - sqrt(5)
    [](const auto& fold) { return std::string(fold.param.name); });

TEST(CameraByHand, PixelBeyondTheFoldHasNoRay) {
  const CameraModel camera(round_numbers({-0.24, 0, 0, 0, 0}));  // the farthest image is at 2/3 of the fold
  EXPECT_TRUE(camera.ray({640 + 1000 * 0.78, 360}));
  EXPECT_FALSE(camera.ray({640 + 1000 * 0.79, 360}));
  EXPECT_FALSE(camera.ray({640, 360 - 800 * 0.79}));
}

TEST(CameraByHand, UndistortedLensSeesAllThatIsInFront) {
  const CameraModel camera(round_numbers());
  EXPECT_TRUE(camera.pixel({1e4, -1e4, 1}));
  EXPECT_TRUE(camera.pixel({0, 0, 2e-6}));
  EXPECT_FALSE(camera.pixel({0, 0, 0.5e-6}));
}

TEST(CameraByHand, ImageReachesHalfAPixelBeyondItsOuterPixelCentres) {
  const CameraModel camera(round_numbers());
  for (const double margin_px : {0.0, 10.0}) {
    const double left = -0.5 + margin_px, right = 1279.5 - margin_px;
    const double top = -0.5 + margin_px, bottom = 719.5 - margin_px;
    EXPECT_TRUE(camera.contains({left, top}, margin_px));
    EXPECT_TRUE(camera.contains({right, bottom}, margin_px));
    EXPECT_FALSE(camera.contains({left - 0.01, 100}, margin_px));
    EXPECT_FALSE(camera.contains({right + 0.01, 100}, margin_px));
    EXPECT_FALSE(camera.contains({100, top - 0.01}, margin_px));
    EXPECT_FALSE(camera.contains({100, bottom + 0.01}, margin_px));
  }
}

}  // namespace
}  // namespace geoloc
