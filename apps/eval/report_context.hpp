// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/estimation_config.hpp"

namespace geoloc::apps {

/// What a report is of, so that it can be made again.
struct ReportContext {
  std::string command;
  std::string made_at;  ///< UTC, ISO 8601
  std::string version;
  std::vector<std::string> settings;  ///< `joint.gate = 9`: those of the estimator that are not the defaults
};

/// The arguments as a shell takes them.
std::string command_of(int argc, const char* const* argv);

std::vector<std::string> changed_settings(const EstimationConfig& config);

}  // namespace geoloc::apps
