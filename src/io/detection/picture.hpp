// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace geoloc::io {

/// In three channels; empty where it is no such picture as Detector::detect() takes.
cv::Mat as_bgr(const cv::Mat& picture);

}  // namespace geoloc::io
