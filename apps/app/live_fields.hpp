// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/live_config.hpp"
#include "common/estimation_fields.hpp"
#include "io/detection/detection_fields.hpp"
#include "io/video/video_fields.hpp"

namespace geoloc::apps {

template <class Visitor>
void visit_fields(Visitor& v, LiveConfig& config) {
  visit_fields(v, config.estimation);
  v.section("video", config.video);
  v.section("detection", config.detection);
}

}  // namespace geoloc::apps
