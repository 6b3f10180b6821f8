// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace geoloc::io {

/// The picture in three channels; empty if Detector::detect() does not accept it.
cv::Mat as_bgr(const cv::Mat& picture);

}  // namespace geoloc::io
