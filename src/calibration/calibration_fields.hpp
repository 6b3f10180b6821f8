// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/calibration/calibration.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, CalibrationPrior& prior) {
  constexpr Range kBoresight = Range::closed(-30, 30);
  constexpr Range kSigma = Range::closed(0, 100);
  v.field("boresight_x_deg", prior.boresight_x_deg, kBoresight, "deg",
          "How far the camera is turned from its nominal mount about its own x axis (right)");
  v.field("boresight_y_deg", prior.boresight_y_deg, kBoresight, "deg", "The same about its y axis (down)");
  v.field("boresight_z_deg", prior.boresight_z_deg, kBoresight, "deg", "The same about its z axis (forward)");
  v.field("latency_s", prior.latency_s, Range::closed(-5, 5), "s",
          "A frame shows the world this long before its stamp");
  v.field("height_m", prior.height_m, Range::closed(-100, 100), "m",
          "The camera is this much higher above the ground than reported");
  v.field("focal_percent", prior.focal_percent, Range::closed(-50, 50), "%",
          "The camera's focal length is this much longer than it is said to be");
  v.field("position_lag_s", prior.position_lag_s, Range::closed(-1, 1), "s",
          "The vehicle reports where it was this long before, as seen against its attitude");
  v.field("sigma_boresight_x_deg", prior.sigma_boresight_x_deg, kSigma, "deg",
          "1-sigma of boresight_x_deg before the flight; 0 freezes it");
  v.field("sigma_boresight_y_deg", prior.sigma_boresight_y_deg, kSigma, "deg",
          "1-sigma of boresight_y_deg before the flight; 0 freezes it");
  v.field("sigma_boresight_z_deg", prior.sigma_boresight_z_deg, kSigma, "deg",
          "1-sigma of boresight_z_deg before the flight, the compass' constant error included; 0 freezes it");
  v.field("sigma_latency_s", prior.sigma_latency_s, kSigma, "s",
          "1-sigma of latency_s before the flight: exposure, encoder, link and clock together; 0 freezes it");
  v.field("sigma_height_m", prior.sigma_height_m, kSigma, "m",
          "Scale of height_m before the flight; the tails are heavy, since the take-off may lie elsewhere; 0 "
          "freezes it");
  v.field("sigma_focal_percent", prior.sigma_focal_percent, Range::closed(0, 50), "%",
          "1-sigma of focal_percent before the flight: 0.3 for a calibrated camera, 2 for a data sheet's "
          "field of view, 3 to 5 for an equivalent for film of 35 mm; 0 freezes it");
  v.field("sigma_position_lag_s", prior.sigma_position_lag_s, Range::closed(0, 1), "s",
          "1-sigma of position_lag_s before the flight: autopilots allow for their receiver's delay by a "
          "guess; 0 freezes it");
}

}  // namespace geoloc
