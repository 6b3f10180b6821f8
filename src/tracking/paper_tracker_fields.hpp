// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/tracking/paper_tracker_config.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, PaperTrackerConfig& paper) {
  v.field("measurement_sigma_m", paper.measurement_sigma_m, Range::above(0, 1000), "m",
          "1-sigma of one fix per axis, calibration errors included (R)");
  v.field("process_sigma_m", paper.process_sigma_m, Range::closed(0, 100), "m",
          "1-sigma per axis that is added at every update and keeps the filter awake (Q)");
  v.field("gate", paper.gate, Range::above(0, 100), "",
          "Largest Mahalanobis distance (eq. 11) of an accepted pair");
  v.field("confirm_hits", paper.confirm_hits, Range::at_least(1), "", "Detections that confirm an object");
  v.field("max_penalty", paper.max_penalty, Range::at_least(1), "",
          "Misses, less hits, that remove an object");
  v.field("visible_margin_px", paper.visible_margin_px, Range::closed(0, Range::kInfinity), "px",
          "Nearer to the image's edge a missing detection is not held against an object");
  v.field("merge_distance_m", paper.merge_distance_m, Range::at_least(0), "m",
          "Confirmed objects that come closer are one: the size of an object");
  v.field("max_tracks", paper.max_tracks, Range::closed(1, 100000), "",
          "Most objects at a time; further ones are rejected and counted");
}

}  // namespace geoloc
