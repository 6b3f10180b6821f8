// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/chart.hpp"
#include "eval/sweep_run.hpp"

namespace geoloc::apps {

/// One method at one value of a sweep.
struct SweepCell {
  Contender contender;
  int runs = 0;
  std::optional<double> mean_rmse_m;  ///< over the runs that found anything
  std::optional<double> mean_relative_rmse_m;
  int found = 0;
  int targets = 0;
  int extra = 0;
  int merged_pairs = 0;
  std::optional<double> mean_nees;
};

/// One for each method, in the order of the runs.
std::vector<SweepCell> cells_of(const SweepPoint& point);

/// RMSE against the value, a curve a method; shares found and extra objects below.
Chart chart_of(const SweepResult& result);

/// A table for each sweep.
std::string sweeps_to_markdown(const std::vector<SweepResult>& results);

nlohmann::ordered_json sweeps_to_json(const std::vector<SweepResult>& results);

}  // namespace geoloc::apps
