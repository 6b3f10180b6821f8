// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eval/rendered_run.hpp"

namespace geoloc::apps {

/// A table of the runs; empty without any.
std::string rendered_to_markdown(const std::vector<RenderedRun>& runs);

/// "from_pictures" and "from_model", each a list of runs.
nlohmann::ordered_json rendered_to_json(const std::vector<RenderedRun>& runs);

}  // namespace geoloc::apps
