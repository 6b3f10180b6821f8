// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/estimation_config.hpp"
#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/video/video_config.hpp"

namespace geoloc::apps {

/// Everything geoloc_app can be told in its configuration file.
struct LiveConfig {
  EstimationConfig estimation;
  io::VideoConfig video;
  io::DetectionConfig detection;
};

nlohmann::ordered_json live_to_json(const LiveConfig& config);

/// Every setting with default, range, unit and meaning, as a Markdown table (docs/settings.md).
std::string live_settings_table();

/// Reads over `config`; every fault is added to `problems`, named by its path.
void live_from_json(const nlohmann::json& document, LiveConfig& config, std::vector<std::string>& problems);

}  // namespace geoloc::apps
