// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/estimation_config.hpp"
#include "common/output_options.hpp"

namespace geoloc::apps {

/// Settings without effect in a run: a section or one setting by its path, and why.
struct Ignored {
  std::string path;
  const char* reason;
};

/// Those of the method that is not chosen and of outputs that are not asked for.
std::vector<Ignored> ignored_by(const EstimationConfig& config, const OutputOptions& outputs);

/// A line for each reason for which settings of the document change nothing, naming them, without those whose
/// value is that of `before`. `name`: the document's, for the messages.
std::vector<std::string> ignored_settings(const nlohmann::json& document, const nlohmann::json& before,
                                          const std::vector<Ignored>& ignored, const std::string& name);

}  // namespace geoloc::apps
