// SPDX-License-Identifier: Apache-2.0
#include "picture.hpp"

#include <opencv2/imgproc.hpp>

namespace geoloc::io {

cv::Mat as_bgr(const cv::Mat& picture) {
  if (picture.dims != 2 || picture.empty() || picture.depth() != CV_8U) return {};
  cv::Mat bgr;
  if (picture.channels() == 3) return picture;
  if (picture.channels() == 1) cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  if (picture.channels() == 4) cv::cvtColor(picture, bgr, cv::COLOR_BGRA2BGR);
  return bgr;
}

}  // namespace geoloc::io
