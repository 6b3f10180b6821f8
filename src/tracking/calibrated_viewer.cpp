// SPDX-License-Identifier: Apache-2.0
#include "tracking/calibrated_viewer.hpp"

#include <algorithm>

namespace geoloc {

double CalibratedViewer::image_scale() const {
  constexpr double kUsualWidth_px = 1280.0;
  return projector.camera().intrinsics().width_px / kUsualWidth_px;
}

std::optional<FrameView> CalibratedViewer::at(FrameStamp stamp, double latency_s) const {
  const auto found = viewer.nominal_view(stamp, latency_s);
  if (!found) return std::nullopt;
  FrameView nominal = *found;
  nominal.terrain_m = terrain_m;
  const double reported_m = reported_height_m(nominal, projector.config());
  if (calibration_is_void) {
    const double lift_m = std::max(errors.height_prior.mean_m, kUsualHeight_m - reported_m);
    return calibrated(nominal, Calibration{}, lift_m);
  }
  return calibrated(nominal, errors.calibration, errors.lift_m(reported_m));
}

}  // namespace geoloc
