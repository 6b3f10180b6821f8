// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "eval/experiment.hpp"
#include "eval/sweep.hpp"

namespace geoloc::apps {

struct SweepPoint {
  double value = 0.0;
  std::vector<RunResult> runs;  ///< by flight, seed, method
  int in_view = 0;  ///< targets that stood wholly in three frames at least, over the runs of a method
};

struct SweepResult {
  Sweep sweep;
  std::vector<SweepPoint> points;
};

/// Every flight of the experiment over scenario 1, for each of its seeds, with both methods, at every value.
/// The result does not depend on the number of threads.
std::vector<SweepResult> run_sweeps(const Experiment& experiment, const std::vector<Sweep>& sweeps,
                                    unsigned threads,
                                    const std::function<void(std::size_t done, std::size_t total)>& on_step);

}  // namespace geoloc::apps
