// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/tracking/known_points.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, KnownPoint& point) {
  constexpr int kAnyClass = -1;
  int class_id = point.class_id.value_or(kAnyClass);
  v.field("name", point.name, Any{}, "", "Its name in messages and in the output");
  v.field("latitude_deg", point.position.latitude_deg, Range::closed(-90, 90), "deg", "WGS84");
  v.field("longitude_deg", point.position.longitude_deg, Range::closed(-360, 360), "deg", "WGS84");
  v.field("sigma_m", point.sigma_m, Range::above(0, 100), "m", "1-sigma of the survey per axis");
  v.field("height_m", point.height_m, Range::closed(-20000, 20000), "m",
          "Height above any level that is the same for all points");
  v.field("sigma_height_m", point.sigma_height_m, Range::closed(0, 100), "m",
          "1-sigma of that height; 0: it is not known");
  v.field("class_id", class_id, Any{}, "", "Class of the object; -1: any");
  point.class_id = class_id == kAnyClass ? std::nullopt : std::optional<int>(class_id);
}

}  // namespace geoloc
