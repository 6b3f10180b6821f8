// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "eval/eval_results.hpp"

namespace geoloc::apps {

/// The tables. Each stands between two comments that name it, so that docs/results.md can take it over.
std::string to_markdown(const EvalResults& results);

/// report.html, report.md, report.json and the pictures: those of run_charts() and sweep_NAME.svg. Throws
/// std::runtime_error naming a file that cannot be written and the reason.
void write_report(const std::filesystem::path& folder, const EvalResults& results);

}  // namespace geoloc::apps
