// SPDX-License-Identifier: Apache-2.0
#include "periodic_noise.hpp"

#include <opencv2/imgproc.hpp>

namespace geoloc::sim {
namespace {

cv::Mat with_unit_variance(const cv::Mat& noise) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  return (noise - mean) * (1.0 / deviation[0]);
}

}  // namespace

cv::Mat periodic_noise(int size, int cells, cv::RNG& random) {
  constexpr int kMargin = 4;  // cells: more than bicubic interpolation reads
  cv::Mat values(cells, cells, CV_32FC1);
  random.fill(values, cv::RNG::NORMAL, 0.0, 1.0);
  cv::Mat padded, enlarged;
  cv::copyMakeBorder(values, padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  const int scale = size / cells;
  cv::resize(padded, enlarged, padded.size() * scale, 0, 0, cv::INTER_CUBIC);
  return with_unit_variance(enlarged(cv::Rect(kMargin * scale, kMargin * scale, size, size)));
}

cv::Mat fractal_noise(int size, int coarsest, int finest, double persistence, cv::RNG& random) {
  cv::Mat sum = cv::Mat::zeros(size, size, CV_32FC1);
  double strength = 1.0;
  for (int cells = coarsest; cells <= finest; cells *= 2) {
    cv::scaleAdd(periodic_noise(size, cells, random), strength, sum, sum);
    strength *= persistence;
  }
  return with_unit_variance(sum);
}

void draw_periodic(int size, cv::Point2f position, float reach,
                   const std::function<void(cv::Point2f)>& draw) {
  const auto period = static_cast<float>(size);
  for (const float dx : {-period, 0.0f, period}) {
    for (const float dy : {-period, 0.0f, period}) {
      const cv::Point2f copy = position + cv::Point2f(dx, dy);
      const bool seen =
          copy.x > -reach && copy.x < period + reach && copy.y > -reach && copy.y < period + reach;
      if (seen) draw(copy);
    }
  }
}

}  // namespace geoloc::sim
