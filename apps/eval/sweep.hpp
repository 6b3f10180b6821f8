// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eval/experiment.hpp"

namespace geoloc::apps {

/// One circumstance of a run, varied while all others, and every setting of the estimator, stay the usual
/// ones.
struct Sweep {
  std::string name;
  std::string title;
  std::string axis;  ///< label of the value, with its unit
  bool is_logarithmic = false;
  std::vector<double> values;
  double usual = 0.0;               ///< value of all other runs
  bool leaves_targets_out = false;  ///< some targets may never come into view

  /// The flight at a value; empty: as recorded.
  std::function<sim::Flight(const sim::Flight& recorded, double value)> flight_at = {};
  /// What else the value changes; empty: nothing.
  std::function<void(double value, const sim::Flight& flight, sim::RecordingSettings& settings)> apply = {};
  /// The targets at a value; empty: those of the scenario.
  std::function<std::vector<Eigen::Vector2d>(double value, std::uint64_t seed)> targets_at = {};
};

/// All there are.
const std::vector<Sweep>& all_sweeps();

/// One of them, or all for "all". Throws std::runtime_error that lists them for an unknown name.
std::vector<Sweep> find_sweeps(const std::string& name);

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
