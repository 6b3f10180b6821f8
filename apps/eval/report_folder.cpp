// SPDX-License-Identifier: Apache-2.0
#include "eval/report_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "eval/html_page.hpp"
#include "eval/report.hpp"
#include "eval/run_charts.hpp"
#include "eval/sweep_report.hpp"
#include "geoloc/io/atomic_file.hpp"

namespace geoloc::apps {
namespace {

/// Empty for an empty text.
std::string named_block(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("<!-- begin {0} -->\n{1}<!-- end {0} -->\n", name, text);
}

std::string rendered_to_markdown(const std::vector<RenderedRun>& runs) {
  if (runs.empty()) return "";
  std::string text =
      "| flight | scenario | method | frames | found | extra | RMSE m | drawn detections: found | extra | "
      "RMSE m | "
      "RMSE ratio |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const RenderedRun& run : runs) {
    const RunResult& pictures = run.from_pictures;
    const Score& model = run.from_model.score;
    fmt::format_to(std::back_inserter(text),
                   "| {} | {} | {} | {} | {}/{} | {} | {:.3f} | {}/{} | {} | {:.3f} | {:.2f} |\n",
                   pictures.flight, pictures.scenario, name_of(pictures.contender), run.frames,
                   pictures.score.found, pictures.score.targets, pictures.score.extra, pictures.score.rmse_m,
                   model.found, model.targets, model.extra, model.rmse_m, rmse_ratio(run));
  }
  return text;
}

nlohmann::ordered_json rendered_to_json(const std::vector<RenderedRun>& rendered) {
  std::vector<RunResult> from_pictures, from_model;
  for (const RenderedRun& run : rendered) {
    from_pictures.push_back(run.from_pictures);
    from_model.push_back(run.from_model);
  }
  return {{"from_pictures", to_json(from_pictures)["runs"]}, {"from_model", to_json(from_model)["runs"]}};
}

std::string to_json_text(const EvalResults& results) {
  auto document = to_json(results.runs);
  if (!results.sweeps.empty()) document["sweeps"] = sweeps_to_json(results.sweeps);
  if (!results.rendered.empty()) document["rendered"] = rendered_to_json(results.rendered);
  return document.dump(1) + "\n";
}

}  // namespace

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
  return charts;
}

std::string to_markdown(const EvalResults& results) {
  return named_block("table", results.runs.empty() ? "" : to_markdown(results.runs)) +
         named_block("sweeps", sweeps_to_markdown(results.sweeps)) +
         named_block("rendered", rendered_to_markdown(results.rendered));
}

void write_report(const std::filesystem::path& folder, const EvalResults& results) {
  std::filesystem::create_directories(folder);
  io::write_file_atomically(folder / "report.html", to_html(results));
  io::write_file_atomically(folder / "report.md", to_markdown(results));
  io::write_file_atomically(folder / "report.json", to_json_text(results));
  for (const NamedChart& named : run_charts(results))
    io::write_file_atomically(folder / (named.name + ".svg"), to_svg_file(named.chart));
  for (const SweepResult& result : results.sweeps) {
    io::write_file_atomically(folder / ("sweep_" + result.sweep.name + ".svg"),
                              to_svg_file(chart_of(result)));
  }
}

}  // namespace geoloc::apps
