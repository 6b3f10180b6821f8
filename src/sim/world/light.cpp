// SPDX-License-Identifier: Apache-2.0
#include "light.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc::sim {
namespace {

const Eigen::Array3f kHorizon(0.86f, 0.82f, 0.78f);  // blue, green, red
const Eigen::Array3f kZenith(0.78f, 0.56f, 0.36f);

}  // namespace

Light::Light(const GroundGrid& grid, const cv::Size& image, const RenderSettings& settings)
    : visibility_m_(static_cast<float>(settings.visibility_m)) {
  const double warm = 0.08 * settings.warmth;
  gain_ = (255.0 * settings.exposure * Eigen::Array3d(1.0 - warm, 1.0, 1.0 + warm)).cast<float>();
  const Eigen::Vector2d middle(0.5 * (image.width - 1), 0.5 * (image.height - 1));
  fall_off_.reserve(grid.size());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Eigen::Vector2d pixel(GroundGrid::pixel_of(column), GroundGrid::pixel_of(row));
      const double corner = (pixel - middle).squaredNorm() / middle.squaredNorm();
      fall_off_.push_back(static_cast<float>(std::max(1.0 - settings.vignetting * corner, 0.0)));
    }
  }
}

Eigen::Array3f Light::seen(const Eigen::Array3f& reflectance, const GroundGrid& grid, int column,
                           int row) const {
  const float clear = std::exp(-grid.node(column, row).range_m / visibility_m_);
  const float fall_off = fall_off_[grid.index(column, row)];
  return gain_ * fall_off * (reflectance * clear + kHorizon * (1.0f - clear));
}

Eigen::Array3f Light::sky(const GroundGrid& grid, int column, int row) const {
  const float up = std::clamp(3.0f * grid.node(column, row).upward, 0.0f, 1.0f);
  const float fall_off = fall_off_[grid.index(column, row)];
  return gain_ * fall_off * (kHorizon * (1.0f - up) + kZenith * up);
}

}  // namespace geoloc::sim
