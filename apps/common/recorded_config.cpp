// SPDX-License-Identifier: Apache-2.0
#include "common/recorded_config.hpp"

#include <utility>

namespace geoloc::apps {

const std::vector<std::string> kLiveSections{"video", "detection"};

nlohmann::json recorded_settings(const std::string& text) {
  nlohmann::json settings = nlohmann::json::parse(text, nullptr, false);
  if (!settings.is_object()) return settings;
  if (settings.value("method", nlohmann::json()) == "full") settings["method"] = "joint";
  if (settings.contains("full") && !settings.contains("joint")) {
    settings["joint"] = std::move(settings["full"]);
    settings.erase("full");
  }
  return settings;
}

void apply_settings(const nlohmann::json& document, const std::string& name, EstimationConfig& config) {
  std::vector<std::string> problems;
  estimation_from_json(document, kLiveSections, config, problems);
  refuse_problems(name, problems);
}

}  // namespace geoloc::apps
