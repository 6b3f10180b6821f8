// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "eval/chart.hpp"
#include "eval/eval_results.hpp"
#include "eval/experiment.hpp"

namespace geoloc::apps {

/// RMSE of the joint method against that of the paper's on the same run, a point a run, a series a set.
Chart methods_chart(const std::vector<RunResult>& runs);

/// Both tilts of the camera as estimated against as injected, with the stated sigma.
Chart boresight_chart(const std::vector<RunResult>& runs);

/// The latency's error against the latency, with the stated sigma.
Chart latency_chart(const std::vector<RunResult>& runs);

/// NEES of the joint method on each path.
Chart consistency_chart(const std::vector<RunResult>& runs);

struct NamedChart {
  std::string name;
  Chart chart;
};

/// What the runs of the table show, and those of the latency's sweep; without what there is no data for.
std::vector<NamedChart> run_charts(const EvalResults& results);

}  // namespace geoloc::apps
