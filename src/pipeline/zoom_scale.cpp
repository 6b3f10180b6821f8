// SPDX-License-Identifier: Apache-2.0
#include "pipeline/zoom_scale.hpp"

#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

/// What fields of view are off by; a zoom farther from the calibration's is another.
constexpr double kMostError = 0.05;
/// Fields of view that are told differ by less while the camera stands still.
constexpr double kStill = 0.002;

double off_by(double zoom) {
  return std::abs(std::log(zoom));
}

/// By the focal length that is the calibration's; nullopt for an angle that no lens has.
std::optional<double> zoom_by(const std::optional<double>& angle_rad, int size_px, double focal_px) {
  if (!angle_rad || !(*angle_rad > 0.0 && *angle_rad < kPi)) return std::nullopt;
  return 0.5 * size_px / std::tan(0.5 * *angle_rad) / focal_px;
}

}  // namespace

std::optional<double> ZoomScale::told_zoom(const FieldOfViewSample& sample) const {
  const auto zoom = zoom_by(sample.horizontal_rad, calibration_.width_px, calibration_.fx_px);
  return zoom ? zoom : zoom_by(sample.vertical_rad, calibration_.height_px, calibration_.fy_px);
}

std::optional<Eigen::Vector2d> ZoomScale::focal_px(const FieldOfViewSample& sample) {
  const auto zoom = told_zoom(sample);
  const Eigen::Vector2d calibrated_px(calibration_.fx_px, calibration_.fy_px);
  if (!zoom || !is_focal_length(*zoom * calibrated_px, calibration_)) return std::nullopt;
  const double before = std::exchange(last_zoom_, zoom).value_or(*zoom);
  const bool stands_still = std::abs(*zoom - before) < kStill * *zoom;
  const double nearest = zoom_at_calibration_ ? off_by(*zoom_at_calibration_) : kMostError;
  if (stands_still && off_by(*zoom) < nearest) zoom_at_calibration_ = zoom;
  return *zoom / zoom_at_calibration_.value_or(1.0) * calibrated_px;
}

}  // namespace geoloc
