// SPDX-License-Identifier: Apache-2.0
#include "sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace geoloc::sim {
namespace {

constexpr int kNoiseMargin_px = 192;  // how far the part that a frame takes may be shifted

}  // namespace

cv::Mat blur_kernel(double sigma_px, const Eigen::Vector2d& motion_px, double longest_px) {
  const double length_px = motion_px.allFinite() ? motion_px.norm() : 0.0;
  const double kept = length_px > longest_px ? longest_px / length_px : 1.0;
  const Eigen::Vector2d motion = length_px > 0.0 ? (kept * motion_px).eval() : Eigen::Vector2d::Zero().eval();
  const double sigma = std::max(sigma_px, 0.2);
  const int radius = static_cast<int>(std::ceil(0.5 * motion.cwiseAbs().maxCoeff() + 2.0 * sigma));
  const int steps = 2 * static_cast<int>(std::ceil(2.0 * motion.norm())) + 1;
  cv::Mat kernel = cv::Mat::zeros(2 * radius + 1, 2 * radius + 1, CV_32FC1);
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector2d at = motion * ((step + 0.5) / steps - 0.5);
    for (int row = -radius; row <= radius; ++row) {
      for (int column = -radius; column <= radius; ++column) {
        const double squared = (Eigen::Vector2d(column, row) - at).squaredNorm();
        kernel.at<float>(row + radius, column + radius) +=
            static_cast<float>(std::exp(-0.5 * squared / (sigma * sigma)));
      }
    }
  }
  return kernel * (1.0 / cv::sum(kernel)[0]);
}

SensorNoise::SensorNoise(const cv::Size& image, double sigma, std::uint64_t seed) : random_(seed) {
  const cv::Size size = image + cv::Size(kNoiseMargin_px, kNoiseMargin_px);
  cv::RNG generator(seed + 1);
  cv::Mat common(size, CV_32FC1), own(size, CV_32FC3), field;
  constexpr double kCommonShare = 0.8,
                   kOwnShare = 0.6;  // most of a camera's noise is grey; the variances add to 1
  generator.fill(common, cv::RNG::NORMAL, 0.0, kCommonShare * sigma);
  generator.fill(own, cv::RNG::NORMAL, 0.0, kOwnShare * sigma);
  cv::cvtColor(common, field, cv::COLOR_GRAY2BGR);
  field += own;
  field.convertTo(brighter_, CV_8UC3);
  field.convertTo(darker_, CV_8UC3, -1.0);
}

void SensorNoise::add_to(cv::Mat& bgr) {
  const cv::Rect part(random_.index(kNoiseMargin_px), random_.index(kNoiseMargin_px), bgr.cols, bgr.rows);
  cv::add(bgr, brighter_(part), bgr);
  cv::subtract(bgr, darker_(part), bgr);
}

}  // namespace geoloc::sim
