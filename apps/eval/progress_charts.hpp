// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "eval/experiment.hpp"
#include "eval/run_charts.hpp"

namespace geoloc::apps {

/// How runs come to their results: RMSE and the share of the targets found, over the time since the first
/// frame, a chart for each set with a curve for each method; and the errors of latency and boresight, with
/// the sigma stated for the former, over all runs of the joint method.
std::vector<NamedChart> progress_charts(const std::vector<RunResult>& runs);

}  // namespace geoloc::apps
