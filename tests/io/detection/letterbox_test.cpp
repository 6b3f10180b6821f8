// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/letterbox.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace geoloc::io {
namespace {

struct Fit {
  const char* name;
  ImageSize picture;
  ImageSize input;
};

class Letterboxes : public ::testing::TestWithParam<Fit> {};

TEST_P(Letterboxes, FillTheInputInOneDirectionAndLieInTheMiddle) {
  const auto [name, picture, input] = GetParam();
  const Letterbox letterbox = fit_letterbox(picture, input);
  EXPECT_TRUE(letterbox.scaled.width_px == input.width_px || letterbox.scaled.height_px == input.height_px);
  const int right = input.width_px - letterbox.scaled.width_px - letterbox.left_px;
  const int bottom = input.height_px - letterbox.scaled.height_px - letterbox.top_px;
  EXPECT_TRUE(right == letterbox.left_px || right == letterbox.left_px + 1);
  EXPECT_TRUE(bottom == letterbox.top_px || bottom == letterbox.top_px + 1);
  EXPECT_GE(letterbox.left_px, 0);
  EXPECT_GE(letterbox.top_px, 0);
}

TEST_P(Letterboxes, ThereAndBackIsIdentity) {
  const Letterbox letterbox = fit_letterbox(GetParam().picture, GetParam().input);
  const Box box{3.25, 7.5, 11.0, 4.75};
  const Box back = letterbox.to_picture(letterbox.to_input(box));
  EXPECT_NEAR(back.x, box.x, 1e-9);
  EXPECT_NEAR(back.y, box.y, 1e-9);
  EXPECT_NEAR(back.width, box.width, 1e-9);
  EXPECT_NEAR(back.height, box.height, 1e-9);
}

TEST_P(Letterboxes, MapTheWholePictureToTheWholeScaledPicture) {
  const auto [name, picture, input] = GetParam();
  const Letterbox letterbox = fit_letterbox(picture, input);
  const Box whole = letterbox.to_input({0, 0, double(picture.width_px), double(picture.height_px)});
  EXPECT_NEAR(whole.x, letterbox.left_px, 1e-9);
  EXPECT_NEAR(whole.y, letterbox.top_px, 1e-9);
  EXPECT_NEAR(whole.width, letterbox.scaled.width_px, 1e-9);
  EXPECT_NEAR(whole.height, letterbox.scaled.height_px, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, Letterboxes,
    ::testing::Values(Fit{"HdToWide", {1280, 720}, {640, 384}}, Fit{"HdToSquare", {1280, 720}, {640, 640}},
                      Fit{"Same", {640, 384}, {640, 384}}, Fit{"Enlarged", {100, 31}, {640, 640}},
                      Fit{"Upright", {1080, 1919}, {640, 384}}, Fit{"OddSizes", {1917, 1003}, {416, 416}},
                      Fit{"OneLine", {10000, 1}, {640, 384}}, Fit{"OnePixel", {1, 1}, {64, 64}}),
    [](const auto& instance) { return std::string{instance.param.name}; });

/// The step between two grey values, in continuous coordinates, from the mass of the dark side.
double edge_of(const cv::Mat& row_image) {
  double dark = 0;
  for (int x = 0; x < row_image.cols; ++x) dark += (200.0 - row_image.at<uchar>(0, x)) / 200.0;
  return dark;
}

/// The mapping of boxes relies on this: cv::resize keeps continuous edges.
TEST(Letterbox, AnEdgeInThePictureIsWhereTheMappingSaysItIs) {
  for (const int scaled_px : {320, 427, 640, 1000, 1280}) {
    cv::Mat picture{1, 640, CV_8UC1, cv::Scalar{200}};
    picture.colRange(0, 200).setTo(0);
    cv::Mat scaled;
    cv::resize(picture, scaled, {scaled_px, 1}, 0, 0, cv::INTER_LINEAR);
    const Letterbox letterbox = fit_letterbox({640, 1}, {scaled_px, scaled_px});
    EXPECT_NEAR(edge_of(scaled), letterbox.to_input({0, 0, 200, 1}).width, 0.05) << scaled_px;
  }
}

/// What this means for coordinates of pixel centres (Box::centre): they are half a pixel less on either side.
TEST(Letterbox, ThePixelAtACornerKeepsItsCorner) {
  const Letterbox letterbox = fit_letterbox({1280, 768}, {640, 384});
  const Box input_pixel{10, 20, 1, 1};
  const Box in_picture = letterbox.to_picture(input_pixel);
  EXPECT_EQ(input_pixel.centre(), Eigen::Vector2d(10, 20));
  EXPECT_EQ(in_picture.centre(),
            Eigen::Vector2d(20.5, 40.5));  // between the picture's pixels 20 and 21, 40 and 41
}

}  // namespace
}  // namespace geoloc::io
