// SPDX-License-Identifier: Apache-2.0
#include "patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace geoloc::io {
namespace {

constexpr double kSurroundings = 2.0;
constexpr double kLeastSide_px = 16.0;
constexpr double kLeastContrast = 2.0;  // grey levels: what has less is noise, and is not stretched
constexpr std::array<double, 3> kLuma{0.114, 0.587, 0.299};  // shares of blue, green and red

int rounded(double value) {
  return static_cast<int>(std::floor(value + 0.5));
}

struct Light {
  std::array<double, 3> mean{};  // blue, green, red
  double contrast = 0.0;         // standard deviation of the brightness
};

Light light_of(const cv::Mat& patch) {
  std::array<double, 3> sums{};
  double luma_squared = 0.0;
  for (int y = 0; y < patch.rows; ++y) {
    const auto* row = patch.ptr<cv::Vec3b>(y);
    for (int x = 0; x < patch.cols; ++x) {
      double luma = 0.0;
      for (int channel = 0; channel < 3; ++channel) {
        const auto index = static_cast<std::size_t>(channel);
        sums[index] += row[x][channel];
        luma += kLuma[index] * row[x][channel];
      }
      luma_squared += luma * luma;
    }
  }
  const auto count = static_cast<double>(patch.total());
  Light light;
  double mean_luma = 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    light.mean[channel] = sums[channel] / count;
    mean_luma += kLuma[channel] * light.mean[channel];
  }
  light.contrast = std::sqrt(std::max(luma_squared / count - mean_luma * mean_luma, 0.0));
  return light;
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
  const Light light = light_of(patch);
  const double scale = 1.0 / std::max(light.contrast, kLeastContrast);
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const std::size_t channel = 2 - plane;  // red comes first
    for (int y = 0; y < patch.rows; ++y) {
      const auto* row = patch.ptr<cv::Vec3b>(y);
      for (int x = 0; x < patch.cols; ++x)
        *planes++ = static_cast<float>((row[x][static_cast<int>(channel)] - light.mean[channel]) * scale);
    }
  }
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

Box SecondLookAnswer::box_in(const cv::Rect& square) const {
  const double side = square.width;
  return {square.x + (0.5 + off_centre_x - 0.5 * width) * side,
          square.y + (0.5 + off_centre_y - 0.5 * height) * side, width * side, height * side};
}

}  // namespace geoloc::io
