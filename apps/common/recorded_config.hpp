// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/estimation_config.hpp"

namespace geoloc::apps {

/// The sections that only a live run has; a recording's config.json holds them too.
extern const std::vector<std::string> kLiveSections;

/// A recording's own settings. Recordings of before December 2026 call the joint method `full`.
nlohmann::json recorded_settings(const std::string& text);

/// Reads settings over `config`; those of a live run are passed over. Throws std::runtime_error that names
/// their source and every problem.
void apply_settings(const nlohmann::json& document, const std::string& name, EstimationConfig& config);

}  // namespace geoloc::apps
