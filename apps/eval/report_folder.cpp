// SPDX-License-Identifier: Apache-2.0
#include "eval/report_folder.hpp"

#include <fmt/format.h>

#include "eval/experiment_report.hpp"
#include "eval/html_page.hpp"
#include "eval/rendered_report.hpp"
#include "eval/run_charts.hpp"
#include "eval/sweep_report.hpp"
#include "geoloc/io/atomic_file.hpp"

namespace geoloc::apps {
namespace {

constexpr const char* kPage = "report.html";
constexpr const char* kTables = "report.md";
constexpr const char* kData = "report.json";

/// Empty for an empty text.
std::string named_block(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("<!-- begin {0} -->\n{1}<!-- end {0} -->\n", name, text);
}

/// Each between two comments that name it, so that docs/results.md can take it over.
std::string named_tables(const EvalResults& results) {
  return named_block("table", results.runs.empty() ? "" : to_markdown(results.runs)) +
         named_block("sweeps", sweeps_to_markdown(results.sweeps)) +
         named_block("rendered", rendered_to_markdown(results.rendered));
}

std::string to_json_text(const EvalResults& results) {
  auto document = to_json(results.runs);
  if (!results.sweeps.empty()) document["sweeps"] = sweeps_to_json(results.sweeps);
  if (!results.rendered.empty()) document["rendered"] = rendered_to_json(results.rendered);
  return document.dump(1) + "\n";
}

}  // namespace

std::string to_markdown(const EvalResults& results) {
  return (results.runs.empty() ? "" : to_markdown(results.runs)) + sweeps_to_markdown(results.sweeps) +
         rendered_to_markdown(results.rendered);
}

void check_report_folder(const std::filesystem::path& folder, const NamedFiles& inputs) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) io::fail_to_write(folder, error.value());
  refuse_recording("--report", folder);
  check_outputs({{"--report", folder / kPage}, {"--report", folder / kTables}, {"--report", folder / kData}},
                inputs);
}

void write_report(const std::filesystem::path& folder, const EvalResults& results,
                  const ReportContext& context) {
  io::write_file_atomically(folder / kPage, to_html(results, context));
  io::write_file_atomically(folder / kTables, named_tables(results));
  io::write_file_atomically(folder / kData, to_json_text(results));
  for (const NamedChart& named : run_charts(results))
    io::write_file_atomically(folder / (named.name + ".svg"), to_svg_file(named.chart));
  for (const SweepResult& result : results.sweeps) {
    io::write_file_atomically(folder / ("sweep_" + result.sweep.name + ".svg"),
                              to_svg_file(chart_of(result)));
  }
}

}  // namespace geoloc::apps
