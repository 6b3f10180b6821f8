// SPDX-License-Identifier: Apache-2.0
#include "patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace geoloc::io {
namespace {

constexpr double kSurroundings = 2.0;
constexpr double kLeastSide_px = 16.0;
constexpr double kLeastContrast = 2.0;  // grey levels: less contrast is noise, and is not stretched
constexpr double kSurelyNone = 0.05;
constexpr double kSurelyOne = 0.98;
constexpr double kLeastScore = 1e-6;              // scores nearer to 0 and 1 carry no more information
const cv::Matx13f kLuma{0.114F, 0.587F, 0.299F};  // shares of blue, green and red

int rounded(double value) {
  return static_cast<int>(std::floor(value + 0.5));
}

double logit(double score) {
  const double clamped = std::clamp(score, kLeastScore, 1.0 - kLeastScore);
  return std::log(clamped / (1.0 - clamped));
}

double score_of(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

}  // namespace

cv::Rect patch_around(const Box& box, cv::Size picture) {
  const int largest = std::min(picture.width, picture.height);
  const int side =
      std::min(rounded(std::max(kSurroundings * std::max(box.width, box.height), kLeastSide_px)), largest);
  return {rounded(box.x + 0.5 * box.width - 0.5 * side), rounded(box.y + 0.5 * box.height - 0.5 * side), side,
          side};
}

cv::Mat cut_patch(const cv::Mat& bgr, const cv::Rect& square, int side_px) {
  const cv::Rect inside = square & cv::Rect{0, 0, bgr.cols, bgr.rows};
  cv::Mat whole = bgr(inside);
  if (inside != square) {
    cv::copyMakeBorder(bgr(inside), whole, inside.y - square.y, square.br().y - inside.br().y,
                       inside.x - square.x, square.br().x - inside.br().x,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  }
  cv::Mat patch;
  cv::resize(whole, patch, {side_px, side_px}, 0, 0,
             square.width > side_px ? cv::INTER_AREA : cv::INTER_LINEAR);
  return patch;
}

void write_normalised(const cv::Mat& patch, float* planes) {
  cv::Mat pixels, luma;
  patch.convertTo(pixels, CV_32F);
  cv::transform(pixels, luma, kLuma);
  cv::Scalar mean, deviation;
  cv::meanStdDev(luma, mean, deviation);
  const cv::Mat normalised = (pixels - cv::mean(pixels)) / std::max(deviation[0], kLeastContrast);
  const auto plane = [&](std::size_t index) {
    return cv::Mat{patch.size(), CV_32F, planes + index * patch.total()};
  };
  std::array<cv::Mat, 3> blue_green_red{plane(2), plane(1), plane(0)};
  cv::split(normalised, blue_green_red);
}

SecondLookAnswer::SecondLookAnswer(const float* values)
    : score(values[0]),
      off_centre_x(values[1]),
      off_centre_y(values[2]),
      width(values[3]),
      height(values[4]),
      sigma(values[5]) {}

bool SecondLookAnswer::is_sound() const {
  const bool is_finite = std::isfinite(off_centre_x) && std::isfinite(off_centre_y) && std::isfinite(width) &&
                         std::isfinite(height) && std::isfinite(sigma);
  return is_finite && score >= 0.0 && score <= 1.0 && width > 0.0 && height > 0.0 && sigma >= 0.0;
}

bool SecondLookAnswer::is_in_doubt() const {
  return score > kSurelyNone && score < kSurelyOne;
}

Box SecondLookAnswer::box_in(const cv::Rect& square) const {
  const double side = square.width;
  return {square.x + (0.5 + off_centre_x - 0.5 * width) * side,
          square.y + (0.5 + off_centre_y - 0.5 * height) * side, width * side, height * side};
}

std::array<cv::Mat, 2> mirrored(const cv::Mat& patch) {
  std::array<cv::Mat, 2> images;
  cv::flip(patch, images[0], 1);
  cv::flip(patch, images[1], 0);
  return images;
}

SecondLookAnswer agreed(const SecondLookAnswer& plain, const SecondLookAnswer& reversed,
                        const SecondLookAnswer& upside_down) {
  SecondLookAnswer mean = plain;
  mean.score = score_of((logit(plain.score) + logit(reversed.score) + logit(upside_down.score)) / 3.0);
  mean.off_centre_x = (plain.off_centre_x - reversed.off_centre_x + upside_down.off_centre_x) / 3.0;
  mean.off_centre_y = (plain.off_centre_y + reversed.off_centre_y - upside_down.off_centre_y) / 3.0;
  return mean;
}

}  // namespace geoloc::io
