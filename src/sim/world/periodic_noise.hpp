// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <opencv2/core.hpp>

namespace geoloc::sim {

/// Smooth noise of unit variance (CV_32FC1, size x size) that repeats without a seam. cells: independent
/// values a side; size must be a multiple of it.
cv::Mat periodic_noise(int size, int cells, cv::RNG& random);

/// Octaves of periodic_noise() from coarsest to finest cells a side, each `persistence` times as strong as
/// the one before; unit variance in all.
cv::Mat fractal_noise(int size, int coarsest, int finest, double persistence, cv::RNG& random);

/// Calls draw with the position and, for one near an edge, with its copies beyond the opposite edges, so that
/// what is drawn with this reach continues over the seam.
void draw_periodic(int size, cv::Point2f position, float reach, const std::function<void(cv::Point2f)>& draw);

}  // namespace geoloc::sim
