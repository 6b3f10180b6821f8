// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/chart.hpp"
#include "eval/experiment.hpp"
#include "eval/rendered.hpp"
#include "eval/sweep.hpp"

namespace geoloc::apps {

/// All that geoloc_eval found out; what was not asked for is empty.
struct EvalResults {
  std::vector<RunResult> runs;
  std::vector<SweepResult> sweeps;
  std::vector<RenderedRun> rendered;
};

struct NamedChart {
  std::string name;
  Chart chart;
};

/// What the runs of the table show, and those of the latency's sweep; without what there is no data for.
std::vector<NamedChart> run_charts(const EvalResults& results);

/// The tables. Each stands between two comments that name it, so that docs/results.md can take it over.
std::string to_markdown(const EvalResults& results);

/// report.html, report.md, report.json and the pictures: those of run_charts() and sweep_NAME.svg. Throws
/// std::runtime_error naming a file that cannot be written and the reason.
void write_report(const std::filesystem::path& folder, const EvalResults& results);

}  // namespace geoloc::apps
