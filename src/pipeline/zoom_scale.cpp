// SPDX-License-Identifier: Apache-2.0
#include "pipeline/zoom_scale.hpp"

#include <cmath>
#include <utility>

#include "geoloc/camera/field_of_view.hpp"

namespace geoloc {
namespace {

/// Fields of view that are told differ by less while the camera stands still.
constexpr double kStill = 0.002;

double off_by(double zoom) {
  return std::abs(std::log(zoom));
}

}  // namespace

std::optional<Eigen::Vector2d> ZoomScale::focal_px(const FieldOfViewSample& sample) {
  const auto zoom = zoom_of_view(sample.horizontal_rad, sample.vertical_rad, calibration_);
  const Eigen::Vector2d calibrated_px(calibration_.fx_px, calibration_.fy_px);
  if (!zoom || !is_focal_length(*zoom * calibrated_px, calibration_)) return std::nullopt;
  const double before = std::exchange(last_zoom_, zoom).value_or(*zoom);
  const bool stands_still = std::abs(*zoom - before) < kStill * *zoom;
  const double nearest = zoom_at_calibration_ ? off_by(*zoom_at_calibration_) : kMostViewError;
  if (stands_still && off_by(*zoom) < nearest) zoom_at_calibration_ = zoom;
  return *zoom / zoom_at_calibration_.value_or(1.0) * calibrated_px;
}

}  // namespace geoloc
