// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/experiment.hpp"

namespace geoloc::apps {

std::string name_of(const Contender& contender);

/// stock_path1 belongs to the set stock.
std::string set_of(const std::string& flight);

/// "–" where there is none.
std::string three_decimals(const std::optional<double>& value);

std::string two_decimals(const std::optional<double>& value);

/// null where there is none.
nlohmann::ordered_json number_or_null(const std::optional<double>& value);

/// "RMSE m / targets found" of one flight and scenario: means over the seeds; empty without such runs.
std::string table_cell(const std::vector<RunResult>& results, const std::string& flight, int scenario,
                       const Contender& contender);

/// Means over the runs of one set of flights (stock, gnss) and one method.
struct Summary {
  std::string set;
  Contender contender;
  int runs = 0;
  std::optional<double> mean_rmse_m;  ///< over the runs that found anything
  std::optional<double> mean_relative_rmse_m;
  int found = 0;
  int targets = 0;
  int extra = 0;
  int merged_pairs = 0;
  std::optional<double> mean_nees;           ///< 2 where stated covariances are right; of the same runs
  double mean_relative_height_rmse_m = 0.0;  ///< 0 where the method estimates no heights
  // Estimated minus injected; 0 where the method estimates none.
  double worst_latency_error_s = 0.0;
  double worst_boresight_error_deg = 0.0;
  double worst_sigmas = 0.0;  ///< the largest of these errors in units of its stated sigma
};

/// One for each set and method, in the order they first appear.
std::vector<Summary> summarize(const std::vector<RunResult>& results);

/// The paper's table 1 for each set and method (means over the seeds), and the summaries.
std::string to_markdown(const std::vector<RunResult>& results);

/// Every run and every summary: "summaries", "runs".
nlohmann::ordered_json to_json(const std::vector<RunResult>& results);

/// A run by both methods.
struct RunPair {
  const RunResult* paper = nullptr;
  const RunResult* joint = nullptr;
  double rmse_difference_m() const { return *joint->score.rmse_m - *paper->score.rmse_m; }
};

/// All runs that both methods made and found something in.
std::vector<RunPair> pairs_of(const std::vector<RunResult>& runs);

}  // namespace geoloc::apps
