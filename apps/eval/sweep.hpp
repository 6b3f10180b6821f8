// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/estimation_config.hpp"
#include "geoloc/sim/flight/recording_generator.hpp"

namespace geoloc::apps {

/// One circumstance of a run, or one setting of the estimator, varied while all others stay the usual ones.
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
  /// What the estimator is told at a value; empty: as always.
  std::function<void(double value, EstimationConfig& config)> configure = {};
};

/// All there are.
const std::vector<Sweep>& all_sweeps();

/// One of them, all for "all", or those of the clocks for "clocks". Throws std::runtime_error that lists them
/// for an unknown name.
std::vector<Sweep> find_sweeps(const std::string& name);

}  // namespace geoloc::apps
