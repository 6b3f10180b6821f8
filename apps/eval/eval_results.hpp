// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "eval/experiment.hpp"
#include "eval/rendered_run.hpp"
#include "eval/sweep_run.hpp"

namespace geoloc::apps {

/// All that geoloc_eval found out; what was not asked for is empty.
struct EvalResults {
  std::vector<RunResult> runs;
  std::vector<SweepResult> sweeps;
  std::vector<RenderedRun> rendered;
};

}  // namespace geoloc::apps
