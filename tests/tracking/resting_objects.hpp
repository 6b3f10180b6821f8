// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tracking/track_table.hpp"

namespace geoloc::testing {

/// A look that shares no error with anything: at its place, with the detector's variance per axis.
inline Look lone_look(const Eigen::Vector2d& place, double variance_m2) {
  Look look;
  look.position = place;
  look.pixel_noise = variance_m2 * Eigen::Matrix2d::Identity();
  look.frame_noise.setZero();
  look.jacobian.setZero();
  look.observation.value = place;
  look.observation.calibration_jacobian.setZero();
  look.observation.node_jacobian.setZero();
  look.observation.span = {0, 0.25};
  look.observation.information = Eigen::Matrix2d::Identity() / variance_m2;
  look.clutter_density = 1e-4;
  look.size_m = 0.5;
  return look;
}

/// An object that so many such looks have shown.
inline RestingObject& append_seen(TrackTable& tracks, const SharedErrorEstimate& errors,
                                  const Eigen::Vector2d& place, int hits, double variance_m2) {
  RestingObject& object = tracks.append();
  object.track.id = tracks.size();
  begin_sums(object, lone_look(place, variance_m2), errors);
  for (int i = 1; i < hits; ++i) add_to_sums(object, lone_look(place, variance_m2), errors);
  object.track.hits = hits;
  return object;
}

}  // namespace geoloc::testing
