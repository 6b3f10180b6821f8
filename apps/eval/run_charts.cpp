// SPDX-License-Identifier: Apache-2.0
#include "eval/run_charts.hpp"

#include <algorithm>
#include <utility>

#include "eval/experiment_report.hpp"
#include "eval/progress_charts.hpp"

namespace geoloc::apps {
namespace {

// Not the styles of the methods.
constexpr int kStockStyle = 2;
constexpr int kOtherStyle = 3;

ChartSeries& series_of_set(Chart& chart, const std::string& set) {
  for (ChartSeries& series : chart.series) {
    if (series.name == set) return series;
  }
  chart.series.push_back({set, set == "stock" ? kStockStyle : kOtherStyle, false, {}});
  return chart.series.back();
}

/// Of stock_path1: 1.
double path_number(const std::string& flight) {
  return flight.back() - '0';
}

}  // namespace

Chart methods_chart(const std::vector<RunResult>& runs) {
  Chart chart;
  chart.title = "Every run: joint against paper";
  chart.x = {"RMSE of paper, m", true, {}};
  chart.y = {"RMSE of joint, m", true, {}};
  chart.has_diagonal = true;
  for (const RunPair& pair : pairs_of(runs)) {
    series_of_set(chart, set_of(pair.joint->flight))
        .points.push_back({*pair.paper->score.rmse_m, *pair.joint->score.rmse_m, 0.0});
  }
  return chart;
}

Chart boresight_chart(const std::vector<RunResult>& runs) {
  Chart chart;
  chart.title = "Mounting error, estimated against injected";
  chart.x = {"injected tilt about the camera's x and y, deg", false, {}};
  chart.y = {"estimated, deg", false, {}};
  chart.has_diagonal = true;
  for (const RunResult& run : runs) {
    if (!run.calibration) continue;
    const CalibrationError& error = *run.calibration;
    for (int axis = 0; axis < 2; ++axis) {
      const double injected_deg = error.injected_boresight_deg[axis];
      series_of_set(chart, set_of(run.flight))
          .points.push_back(
              {injected_deg, injected_deg + error.boresight_deg[axis], error.sigma_boresight_deg[axis]});
    }
  }
  return chart;
}

Chart latency_chart(const std::vector<RunResult>& runs) {
  constexpr double kMsPerS = 1e3;
  constexpr double kAside_s = 0.006;  // runs of one latency would hide each other
  Chart chart;
  chart.title = "Latency, estimated minus injected";
  chart.x = {"injected latency, s (paths 1-6 side by side)", false, {}};
  chart.y = {"estimated minus injected, ms", false, {}};
  chart.right_y = 0.0;
  for (const RunResult& run : runs) {
    if (!run.calibration) continue;
    const CalibrationError& error = *run.calibration;
    series_of_set(chart, set_of(run.flight))
        .points.push_back({error.injected_latency_s + kAside_s * (path_number(run.flight) - 3.5),
                           kMsPerS * error.latency_s, kMsPerS * error.sigma_latency_s});
  }
  return chart;
}

Chart consistency_chart(const std::vector<RunResult>& runs) {
  constexpr double kExpected = 2.0;  // the mean of chi-squared with two degrees of freedom
  constexpr double kAside = 0.12;    // the sets stand beside each other
  Chart chart;
  chart.title = "Is the stated covariance right? NEES of joint";
  chart.x = {"path", false, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}};
  chart.y = {"NEES, one point per run", true, {}};
  chart.right_y = kExpected;
  for (const RunResult& run : runs) {
    if (!(run.contender == Contender{Method::kJoint, 0})) continue;
    const std::string set = set_of(run.flight);
    series_of_set(chart, set)
        .points.push_back({path_number(run.flight) + (set == "stock" ? -kAside : kAside), run.nees, 0.0});
  }
  return chart;
}

std::vector<NamedChart> run_charts(const EvalResults& results) {
  std::vector<RunResult> of_latencies = results.runs;
  for (const SweepResult& result : results.sweeps) {
    if (result.sweep.name != "latency") continue;
    for (const SweepPoint& point : result.points)
      of_latencies.insert(of_latencies.end(), point.runs.begin(), point.runs.end());
  }
  std::vector<NamedChart> charts{{"methods", methods_chart(results.runs)},
                                 {"boresight", boresight_chart(results.runs)},
                                 {"latency", latency_chart(of_latencies)},
                                 {"consistency", consistency_chart(results.runs)}};
  const auto is_empty = [](const NamedChart& named) { return named.chart.series.empty(); };
  charts.erase(std::remove_if(charts.begin(), charts.end(), is_empty), charts.end());
  for (NamedChart& named : progress_charts(results.runs)) charts.push_back(std::move(named));
  return charts;
}

}  // namespace geoloc::apps
