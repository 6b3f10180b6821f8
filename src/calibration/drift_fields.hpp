// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/calibration/drift_config.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, DriftConfig& drift) {
  v.field("node_spacing_s", drift.node_spacing_s, Range::closed(0.5, 600), "s",
          "Time between the nodes of the drift; it is interpolated linearly between them");
  v.field("position_time_constant_s", drift.position_time_constant_s, Range::positive(), "s",
          "Correlation time of the position's drift");
  v.field("ripple_share", drift.ripple_share, Range::closed(0, 0.9), "",
          "Share of the variance of the position's drift that lasts for seconds only");
  v.field("ripple_time_constant_s", drift.ripple_time_constant_s, Range::positive(), "s",
          "Correlation time of that share");
  v.field("up_time_constant_s", drift.up_time_constant_s, Range::positive(), "s",
          "Correlation time of the height's drift");
  v.field("sigma_up_m", drift.sigma_up_m, Range::above(0, 100), "m", "1-sigma of the height's drift");
  v.field("yaw_time_constant_s", drift.yaw_time_constant_s, Range::positive(), "s",
          "Correlation time of the yaw's drift");
  v.field("sigma_yaw_deg", drift.sigma_yaw_deg, Range::above(0, 30), "deg", "1-sigma of the yaw's drift");
  v.field("max_nodes", drift.max_nodes, Range::closed(4, 500), "",
          "Where there are more, older ones are thinned out, the more the older they are");
  v.field("spell_s", drift.spell_s, Range::closed(0.1, 600), "s",
          "Time for which the sway of position and attitude is taken to be constant");
  v.field("sway_time_constant_s", drift.sway_time_constant_s, Range::positive(), "s",
          "Correlation time of the sway");
  v.field("max_spells", drift.max_spells, Range::closed(0, 8), "",
          "Older spells are frozen at their estimates; 0: the sway is not estimated");
}

}  // namespace geoloc
