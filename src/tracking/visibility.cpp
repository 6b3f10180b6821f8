// SPDX-License-Identifier: Apache-2.0
#include "tracking/visibility.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

std::optional<double> ground_per_pixel(const Eigen::Vector2d& pixel, const Projector& projector,
                                       const FrameView& view) {
  const auto fix = projector.project(pixel, view);
  if (!fix) return std::nullopt;
  return std::sqrt(std::abs(fix->ground_from_pixel.determinant()));
}

}  // namespace

double visibility(const ShownObject& object, const Projector& projector, const FrameView& view,
                  double sigma_px, double smallest_object_px) {
  const auto pixel = projector.reproject(object.position_in_enu, view);
  if (!pixel) return 0.0;
  const auto ground_per_pixel_m =
      object.ground_per_pixel_m ? object.ground_per_pixel_m : ground_per_pixel(*pixel, projector, view);
  if (!ground_per_pixel_m) return 0.0;
  const double size_px = object.size_m / *ground_per_pixel_m;
  const double place_sigma_px = object.sigma_m / *ground_per_pixel_m;
  const double margin_px = 0.6 * size_px + 2.0 * std::min(place_sigma_px, size_px) + 2.0 * sigma_px;
  if (!projector.camera().contains(*pixel, margin_px)) return 0.0;
  return std::clamp(size_px / std::max(smallest_object_px, 1e-9) - 1.0, 0.0, 1.0);
}

}  // namespace geoloc
