// SPDX-License-Identifier: Apache-2.0
#include "eval/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "eval/experiment_report.hpp"
#include "eval/mean.hpp"

namespace geoloc::apps {
namespace {

SweepCell& cell_for(std::vector<SweepCell>& cells, const Contender& contender) {
  for (SweepCell& cell : cells) {
    if (cell.contender == contender) return cell;
  }
  cells.push_back({});
  cells.back().contender = contender;
  return cells.back();
}

/// Never rounded up to 100.
std::string percent(int part, int whole) {
  if (whole == 0) return "";
  if (part == whole) return "100";
  return fmt::format("{:.1f}", std::min(99.9, 100.0 * part / whole));
}

/// Paper and joint always look the same.
int style_of(const Contender& contender) {
  return contender.method == Method::kPaper ? 0 : 1;
}

}  // namespace

std::vector<SweepCell> cells_of(const SweepPoint& point) {
  struct Means {
    Mean rmse_m, relative_rmse_m, nees;
  };
  std::vector<SweepCell> cells;
  std::vector<Means> means;
  for (const RunResult& run : point.runs) {
    SweepCell& cell = cell_for(cells, run.contender);
    means.resize(cells.size());
    ++cell.runs;
    cell.found += run.score.found;
    cell.targets += run.score.targets;
    cell.extra += run.score.extra;
    cell.merged_pairs += run.score.merged_pairs;
    Means& mean = means[static_cast<std::size_t>(&cell - cells.data())];
    mean.rmse_m.add(run.score.rmse_m);
    mean.relative_rmse_m.add(run.score.relative_rmse_m);
    if (run.score.found > 0) mean.nees.add(run.nees);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].mean_rmse_m = means[i].rmse_m.value();
    cells[i].mean_relative_rmse_m = means[i].relative_rmse_m.value();
    cells[i].mean_nees = means[i].nees.value();
  }
  return cells;
}

Chart chart_of(const SweepResult& result) {
  Chart chart;
  chart.title = result.sweep.title;
  chart.x = {result.sweep.axis, result.sweep.is_logarithmic, result.sweep.values};
  chart.y = {"RMSE, m", true, {0.05, 0.1, 0.2, 0.5, 1.0, 2.0}};  // alike, so that pictures compare
  chart.usual_x = result.sweep.usual;
  std::vector<ChartRow> found, extra;
  ChartRow in_view{"in view %", 2, {}};
  for (const SweepPoint& point : result.points) {
    const std::vector<SweepCell> cells = cells_of(point);
    chart.series.resize(cells.size());
    found.resize(cells.size());
    extra.resize(cells.size());
    for (std::size_t m = 0; m < cells.size(); ++m) {
      const SweepCell& cell = cells[m];
      const int style = style_of(cell.contender);
      chart.series[m].name = name_of(cell.contender);
      chart.series[m].style = style;
      chart.series[m].is_line = true;
      if (cell.mean_rmse_m) chart.series[m].points.push_back({point.value, *cell.mean_rmse_m, 0.0});
      found[m].name = "found %";
      extra[m].name = "extra";
      found[m].style = extra[m].style = style;
      found[m].cells.push_back({point.value, percent(cell.found, cell.targets)});
      extra[m].cells.push_back({point.value, std::to_string(cell.extra)});
    }
    if (!cells.empty()) in_view.cells.push_back({point.value, percent(point.in_view, cells.front().targets)});
  }
  if (result.sweep.leaves_targets_out) chart.rows.push_back(in_view);
  chart.rows.insert(chart.rows.end(), found.begin(), found.end());
  chart.rows.insert(chart.rows.end(), extra.begin(), extra.end());
  return chart;
}

std::string sweeps_to_markdown(const std::vector<SweepResult>& results) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const SweepResult& result : results) {
    fmt::format_to(
        out,
        "\n{} (usually {:.3g})\n\n| {} | method | RMSE m | relative RMSE m | found | extra | merged pairs | "
        "NEES |\n|---|---|---|---|---|---|---|---|\n",
        result.sweep.title, result.sweep.usual, result.sweep.axis);
    for (const SweepPoint& point : result.points) {
      for (const SweepCell& cell : cells_of(point)) {
        const std::string in_view =
            result.sweep.leaves_targets_out ? fmt::format(" ({} in view)", point.in_view) : "";
        fmt::format_to(out, "| {:g} | {} | {} | {} | {}/{}{} | {} | {} | {} |\n", point.value,
                       name_of(cell.contender), three_decimals(cell.mean_rmse_m),
                       three_decimals(cell.mean_relative_rmse_m), cell.found, cell.targets, in_view,
                       cell.extra, cell.merged_pairs, two_decimals(cell.mean_nees));
      }
    }
  }
  return text;
}

nlohmann::ordered_json sweeps_to_json(const std::vector<SweepResult>& results) {
  auto sweeps = nlohmann::ordered_json::array();
  for (const SweepResult& result : results) {
    auto points = nlohmann::ordered_json::array();
    for (const SweepPoint& point : result.points) {
      for (const SweepCell& cell : cells_of(point)) {
        points.push_back({{"value", point.value},
                          {"method", name_of(cell.contender)},
                          {"runs", cell.runs},
                          {"mean_rmse_m", number_or_null(cell.mean_rmse_m)},
                          {"mean_relative_rmse_m", number_or_null(cell.mean_relative_rmse_m)},
                          {"found", cell.found},
                          {"targets", cell.targets},
                          {"extra", cell.extra},
                          {"merged_pairs", cell.merged_pairs},
                          {"mean_nees", number_or_null(cell.mean_nees)}});
        if (result.sweep.leaves_targets_out) points.back()["in_view"] = point.in_view;
      }
    }
    sweeps.push_back({{"name", result.sweep.name},
                      {"value_is", result.sweep.axis},
                      {"usual_value", result.sweep.usual},
                      {"points", points}});
  }
  return sweeps;
}

}  // namespace geoloc::apps
