// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/projection/projector.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, ProjectorConfig& projector) {
  v.field("ground_height_above_home_m", projector.ground_height_above_home_m, Range::closed(-10000, 10000),
          "m", "Height of the horizontal plane on which the objects lie");
  v.field("max_range_m", projector.max_range_m, Range::above(0, 100000), "m",
          "Fixes farther from the camera are rejected");
  v.field("min_depression_deg", projector.min_depression_deg, Range::open(0, 90), "deg",
          "Rays that meet the ground at a smaller angle are rejected");
}

}  // namespace geoloc
