// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "eval/chart.hpp"
#include "eval/experiment.hpp"

namespace geoloc::apps {

/// RMSE of the joint method against that of the paper on the same run, one point per run and one series per
/// set.
Chart methods_chart(const std::vector<RunResult>& runs);

/// Both tilts of the camera as estimated against as injected, with the stated sigma.
Chart boresight_chart(const std::vector<RunResult>& runs);

/// The latency's error against the latency, with the stated sigma.
Chart latency_chart(const std::vector<RunResult>& runs);

/// NEES of the joint method on each path.
Chart consistency_chart(const std::vector<RunResult>& runs);

/// A run by both methods.
struct RunPair {
  const RunResult* paper = nullptr;
  const RunResult* joint = nullptr;
  double rmse_difference_m() const { return joint->score.rmse_m - paper->score.rmse_m; }
};

/// All runs that both methods made.
std::vector<RunPair> pairs_of(const std::vector<RunResult>& runs);

}  // namespace geoloc::apps
