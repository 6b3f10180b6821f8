// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/output_files.hpp"
#include "eval/eval_results.hpp"
#include "eval/report_context.hpp"

namespace geoloc::apps {

/// The tables, for a terminal.
std::string to_markdown(const EvalResults& results);

/// Makes the folder. Throws std::runtime_error where it cannot be made or written to, is a recording, or
/// where the report would take an input's place.
void check_report_folder(const std::filesystem::path& folder, const NamedFiles& inputs);

/// report.html, report.md, report.json and the pictures: those of run_charts() and sweep_NAME.svg. Throws
/// std::runtime_error naming a file that cannot be written and the reason.
void write_report(const std::filesystem::path& folder, const EvalResults& results,
                  const ReportContext& context);

}  // namespace geoloc::apps
