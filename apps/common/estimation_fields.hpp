// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/estimation_config.hpp"
#include "io/live_page/live_page_fields.hpp"
#include "io/mavlink/mavlink_fields.hpp"
#include "io/output/cot_fields.hpp"
#include "pipeline/geolocator_fields.hpp"
#include "settings/rules.hpp"

namespace geoloc::apps {

template <class Visitor>
void visit_fields(Visitor& v, FrameConfig& frames) {
  v.field("max_wait_s", frames.max_wait_s, Range::closed(0, 60), "s",
          "How long a frame waits for the vehicle's state around it; then it is given up");
}

template <class Visitor>
void visit_fields(Visitor& v, EstimationConfig& config) {
  visit_fields(v, config.geolocator);
  v.section("mavlink", config.mavlink);
  v.section("frames", config.frames);
  v.section("live_page", config.live_page);
  v.section("cot", config.cot);
}

}  // namespace geoloc::apps
