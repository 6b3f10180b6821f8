// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

/// Fine structure of a ground as a factor a channel with mean 1 (CV_32FC3, size x size, periodic).
cv::Mat ground_grain(GroundStyle style, int size, double texel_m, cv::RNG& random);

}  // namespace geoloc::sim
