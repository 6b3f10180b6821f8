// SPDX-License-Identifier: Apache-2.0
#include "geoloc/camera/field_of_view.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

std::optional<double> zoom_by(const std::optional<double>& angle_rad, int size_px, double focal_px) {
  if (!angle_rad || !(*angle_rad > 0.0 && *angle_rad < kPi)) return std::nullopt;
  return 0.5 * size_px / std::tan(0.5 * *angle_rad) / focal_px;
}

}  // namespace

double angle_of_view_rad(int size_px, double focal_px) {
  return 2.0 * std::atan(0.5 * size_px / focal_px);
}

std::optional<double> zoom_of_view(const std::optional<double>& horizontal_rad,
                                   const std::optional<double>& vertical_rad,
                                   const CameraIntrinsics& calibration) {
  const auto zoom = zoom_by(horizontal_rad, calibration.width_px, calibration.fx_px);
  return zoom ? zoom : zoom_by(vertical_rad, calibration.height_px, calibration.fy_px);
}

}  // namespace geoloc
