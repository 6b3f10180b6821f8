// SPDX-License-Identifier: Apache-2.0
#include "eval/progress_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "eval/experiment_report.hpp"
#include "eval/mean.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc::apps {
namespace {

using Value = std::function<std::optional<double>(const RunResult& run, const ProgressSample& sample)>;

/// Means over the runs; a time that not all of them reached is left out, since the others would jump.
ChartSeries mean_over_time(const std::string& name, int style, const std::vector<const RunResult*>& runs,
                           const Value& value) {
  ChartSeries series{name, style, true, {}};
  series.has_marks = false;
  std::size_t shortest = runs.empty() ? 0 : runs.front()->progress.size();
  for (const RunResult* run : runs) shortest = std::min(shortest, run->progress.size());
  for (std::size_t i = 0; i < shortest; ++i) {
    Mean mean;
    for (const RunResult* run : runs) mean.add(value(*run, run->progress[i]));
    if (mean.value())
      series.points.push_back({RunProgress::kPeriod_s * static_cast<double>(i), *mean.value(), 0.0});
  }
  return series;
}

/// A curve for each method on a set of flights.
Chart chart_of_set(const std::vector<RunResult>& runs, const std::string& set, Chart chart,
                   const Value& value) {
  chart.title += ", " + set + " flights";
  chart.x = {"time since the first frame, s", false, {}};
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    std::vector<const RunResult*> its_runs;
    for (const RunResult& run : runs) {
      if (set_of(run.flight) == set && run.contender == Contender{method, 0}) its_runs.push_back(&run);
    }
    if (its_runs.empty()) continue;
    const int style = method == Method::kPaper ? 0 : 1;
    chart.series.push_back(mean_over_time(name_of({method, 0}), style, its_runs, value));
  }
  return chart;
}

std::vector<std::string> sets_of(const std::vector<RunResult>& runs) {
  std::vector<std::string> sets;
  for (const RunResult& run : runs) {
    if (std::find(sets.begin(), sets.end(), set_of(run.flight)) == sets.end())
      sets.push_back(set_of(run.flight));
  }
  return sets;
}

std::vector<const RunResult*> calibrated(const std::vector<RunResult>& runs) {
  std::vector<const RunResult*> found;
  for (const RunResult& run : runs) {
    if (run.calibration && run.contender.known_points == 0) found.push_back(&run);
  }
  return found;
}

Chart latency_convergence(const std::vector<const RunResult*>& runs) {
  Chart chart;
  chart.title = "Latency: error and stated sigma";
  chart.x = {"time since the first frame, s", false, {}};
  chart.y = {"s, mean over the runs", true, {}};
  chart.series.push_back(mean_over_time(
      "error", 1, runs, [](const RunResult& run, const ProgressSample& sample) -> std::optional<double> {
        if (!sample.latency_s) return std::nullopt;
        return std::abs(*sample.latency_s - run.calibration->injected_latency_s);
      }));
  chart.series.push_back(
      mean_over_time("stated sigma", 2, runs,
                     [](const RunResult&, const ProgressSample& sample) { return sample.sigma_latency_s; }));
  return chart;
}

Chart boresight_convergence(const std::vector<const RunResult*>& runs) {
  Chart chart;
  chart.title = "Mounting error that is left";
  chart.x = {"time since the first frame, s", false, {}};
  chart.y = {"tilt of the optical axis, deg", true, {}};
  chart.series.push_back(mean_over_time(
      "error", 1, runs, [](const RunResult& run, const ProgressSample& sample) -> std::optional<double> {
        if (!sample.boresight_rad) return std::nullopt;
        return (*sample.boresight_rad * kDegPerRad - run.calibration->injected_boresight_deg).norm();
      }));
  return chart;
}

}  // namespace

std::vector<NamedChart> progress_charts(const std::vector<RunResult>& runs) {
  Chart error, found;
  error.title = "Error over time";
  error.y = {"RMSE of the targets found so far, m", true, {}};
  found.title = "Targets found over time";
  found.y = {"share of the targets, %", false, {0.0, 25.0, 50.0, 75.0, 100.0}};
  std::vector<NamedChart> charts;
  for (const std::string& set : sets_of(runs)) {
    charts.push_back({"error_over_time_" + set,
                      chart_of_set(runs, set, error, [](const RunResult&, const ProgressSample& sample) {
                        return sample.rmse_m;
                      })});
    charts.push_back({"found_over_time_" + set,
                      chart_of_set(runs, set, found, [](const RunResult&, const ProgressSample& sample) {
                        return std::optional(100.0 * sample.found_share);
                      })});
  }
  const auto joint = calibrated(runs);
  charts.push_back({"latency_convergence", latency_convergence(joint)});
  charts.push_back({"boresight_convergence", boresight_convergence(joint)});
  const auto is_empty = [](const NamedChart& named) {
    return std::all_of(named.chart.series.begin(), named.chart.series.end(),
                       [](const ChartSeries& series) { return series.points.empty(); });
  };
  charts.erase(std::remove_if(charts.begin(), charts.end(), is_empty), charts.end());
  return charts;
}

}  // namespace geoloc::apps
