// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "geoloc/sim/random.hpp"

namespace geoloc::sim {

/// Kernel (CV_32FC1, odd square, sum 1, symmetric about its centre, so it moves nothing) of a Gaussian
/// dragged along a straight motion. The motion is cut at longest_px; one that is not finite counts as none.
cv::Mat blur_kernel(double sigma_px, const Eigen::Vector2d& motion_px, double longest_px);

/// Sensor noise cheap enough for video: one large field, of which every frame takes another part.
class SensorNoise {
 public:
  SensorNoise(const cv::Size& image, double sigma, std::uint64_t seed);
  void add_to(cv::Mat& bgr);

 private:
  cv::Mat brighter_;  // CV_8UC3: noise above zero,
  cv::Mat darker_;    // and below it, because 8-bit images have no sign
  Random random_;
};

}  // namespace geoloc::sim
