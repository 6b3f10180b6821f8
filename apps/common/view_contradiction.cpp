// SPDX-License-Identifier: Apache-2.0
#include "common/view_contradiction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geoloc/camera/field_of_view.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc::apps {
namespace {

double angle_deg(int size_px, double focal_px) {
  return angle_of_view_rad(size_px, focal_px) * kDegPerRad;
}

}  // namespace

/// A camera that has zoomed in may have begun so, and is no contradiction; none zooms out beyond its widest,
/// at which it is to be calibrated.
std::string view_contradiction(const io::LinkStatus& link, const CameraIntrinsics& configured) {
  if (!link.widest_view) return {};
  const auto& [time, horizontal_rad, vertical_rad] = *link.widest_view;
  const auto zoom = zoom_of_view(horizontal_rad, vertical_rad, configured);
  if (!zoom || std::abs(std::log(*zoom)) <= kMostViewError) return {};
  const bool is_wider = *zoom < 1.0;
  if (!is_wider && link.has_zoom_changed) return {};
  const double told_deg = horizontal_rad.value_or(vertical_rad.value_or(0.0)) * kDegPerRad;
  const double configured_deg = horizontal_rad ? angle_deg(configured.width_px, configured.fx_px)
                                               : angle_deg(configured.height_px, configured.fy_px);
  return fmt::format(
      "the camera tells a {} field of view of {:.1f} deg, and by its configuration it is {:.1f} deg: {}; {}",
      horizontal_rad ? "horizontal" : "vertical", told_deg, configured_deg,
      is_wider
          ? "the configuration is of another camera or mode, or of one that was zoomed in (calibrate it "
            "at its widest)"
          : "it has been zoomed in from the beginning, or the configuration is of another camera or mode "
            "(horizontal_fov_deg, or a calibration)",
      link.since_field_of_view ? "frames are located with what it tells"
                               : "frames are located with the configuration");
}

}  // namespace geoloc::apps
