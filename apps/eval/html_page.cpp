// SPDX-License-Identifier: Apache-2.0
#include "eval/html_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "eval/chart.hpp"
#include "eval/experiment_report.hpp"
#include "eval/html_table.hpp"
#include "eval/page_style.hpp"
#include "eval/run_charts.hpp"
#include "eval/sweep_report.hpp"
#include "geoloc/io/output/markup.hpp"
#include "geoloc/io/output/palette.hpp"

namespace geoloc::apps {
namespace {

/// Table 1 of the paper: RMSE [m] and targets found of path 1-6 in scenario 1-3.
struct PublishedRun {
  double rmse_m;
  int found;
};
constexpr int kPaths = 6;
constexpr std::array<std::array<PublishedRun, 3>, kPaths> kPublished{{
    {{{0.49, 30}, {0.52, 29}, {0.72, 30}}},
    {{{0.59, 30}, {0.45, 29}, {0.60, 30}}},
    {{{0.66, 30}, {0.70, 29}, {0.78, 29}}},
    {{{0.50, 30}, {0.47, 28}, {0.48, 29}}},
    {{{0.84, 30}, {0.49, 28}, {0.60, 30}}},
    {{{0.65, 29}, {0.64, 29}, {0.67, 30}}},
}};
constexpr double kPublishedRmse_m = 0.603;

std::string paragraph(const std::string& text) {
  return "<p>" + text + "</p>\n";
}

std::string heading(const char* text) {
  return std::string("<h2>") + text + "</h2>\n";
}

std::string figures(const std::vector<Chart>& charts) {
  std::string html = "<div class=\"charts\">\n";
  for (const Chart& chart : charts) html += "<figure>" + to_svg_element(chart) + "</figure>\n";
  return html + "</div>\n";
}

std::string tile(const char* kind, const std::string& figure, const std::string& meaning) {
  return fmt::format("<div class=\"tile {}\"><b>{}</b><span>{}</span></div>\n", kind, figure, meaning);
}

std::string tiles(const std::vector<Summary>& summaries) {
  std::string html = "<div class=\"tiles\">\n";
  html +=
      tile("", fmt::format("{:.3f} m", kPublishedRmse_m), "published: RMSE, 529 / 540 found, other flights");
  for (const Summary& s : summaries) {
    html += tile(
        s.contender.method == Method::kJoint ? "ours" : "", three_decimals(s.mean_rmse_m) + " m",
        fmt::format("{}, {} flights: RMSE, {} / {} found", name_of(s.contender), s.set, s.found, s.targets));
  }
  return html + "</div>\n";
}

std::string summary_table(const std::vector<Summary>& summaries) {
  HtmlTable table;
  table.header = {
      "",      "runs",         "RMSE m",         "relative RMSE m",       "found",
      "extra", "merged pairs", "NEES, right: 2", "worst latency error s", "worst boresight error °"};
  table.rows.push_back({"published", "18", "0.603", "", "529/540", "", "", "", "", ""});
  for (const Summary& s : summaries) {
    const bool calibrates = s.contender.method == Method::kJoint;
    table.rows.push_back({fmt::format("{}, {}", s.set, name_of(s.contender)), std::to_string(s.runs),
                          three_decimals(s.mean_rmse_m), three_decimals(s.mean_relative_rmse_m),
                          fmt::format("{}/{}", s.found, s.targets), std::to_string(s.extra),
                          std::to_string(s.merged_pairs), two_decimals(s.mean_nees),
                          calibrates ? fmt::format("{:.3f}", s.worst_latency_error_s) : "",
                          calibrates ? fmt::format("{:.2f}", s.worst_boresight_error_deg) : ""});
  }
  return to_html(table);
}

/// The paper's table 1, a table a scenario: published beside every set and method.
std::string scenario_table(const std::vector<RunResult>& runs, const std::vector<Summary>& summaries,
                           int scenario) {
  HtmlTable table;
  table.caption = fmt::format("Scenario {}", scenario);
  table.header = {"path", "published"};
  for (const Summary& s : summaries)
    table.header.push_back(fmt::format("{} {}", s.set, name_of(s.contender)));
  for (int path = 1; path <= kPaths; ++path) {
    const PublishedRun& published =
        kPublished[static_cast<std::size_t>(path - 1)][static_cast<std::size_t>(scenario - 1)];
    std::vector<std::string> row{std::to_string(path),
                                 fmt::format("{:.2f} / {}", published.rmse_m, published.found)};
    for (const Summary& s : summaries)
      row.push_back(table_cell(runs, fmt::format("{}_path{}", s.set, path), scenario, s.contender));
    table.rows.push_back(row);
  }
  return to_html(table);
}

std::string worst_run(const std::vector<RunResult>& runs) {
  const std::vector<RunPair> pairs = pairs_of(runs);
  if (pairs.empty()) return "";
  const auto worst = std::max_element(pairs.begin(), pairs.end(), [](const RunPair& a, const RunPair& b) {
    return a.rmse_difference_m() < b.rmse_difference_m();
  });
  const auto is_worse = [](const RunPair& pair) { return pair.rmse_difference_m() > 0.0; };
  const auto finds_fewer = [](const RunPair& pair) {
    return pair.joint->score.found < pair.paper->score.found;
  };
  return paragraph(
      fmt::format("Joint is worse than paper in {} of {} runs, and finds fewer targets in {}. Its worst run "
                  "against paper "
                  "is {}, "
                  "scenario {}, seed {}: {:.3f} m against {:.3f} m ({:+.3f} m).",
                  std::count_if(pairs.begin(), pairs.end(), is_worse), pairs.size(),
                  std::count_if(pairs.begin(), pairs.end(), finds_fewer), worst->joint->flight,
                  worst->joint->scenario, worst->joint->seed, *worst->joint->score.rmse_m,
                  *worst->paper->score.rmse_m, worst->rmse_difference_m()));
}

std::string table_section(const std::vector<RunResult>& runs) {
  const std::vector<Summary> summaries = summarize(runs);
  std::string html = tiles(summaries);
  html += heading("Summary");
  html += paragraph(
      "Means over all runs; 30 targets per run. <b>stock</b>: the simulator's own sensors. <b>gnss</b>: a "
      "consumer "
      "receiver's errors, whose constant part no onboard method can see. Relative: with each run's mean "
      "offset removed. "
      "NEES: squared error in units of the stated covariance; above 2 the method is too sure of itself, "
      "below too modest.");
  html += summary_table(summaries);
  html += heading("The paper's table 1");
  html += paragraph(
      "RMSE in metres / targets found of 30, means over the seeds. The published figures are of other "
      "flights over other targets, in Gazebo.");
  for (int scenario = 1; scenario <= 3; ++scenario) html += scenario_table(runs, summaries, scenario);
  html += heading("Joint against paper, run by run");
  html += worst_run(runs);
  return html;
}

/// How to read the pictures that there are.
std::string notes_on(const std::vector<NamedChart>& charts) {
  struct Note {
    const char* chart;
    const char* text;
  };
  constexpr Note kNotes[] = {
      {"methods", "Every run: below the dotted line joint is better. "},
      {"boresight",
       "Mounting error: bars are the sigma that the estimator states, the dotted line is the truth. "},
      {"latency", "Latency: bars are the sigma that the estimator states, the dotted line is the truth. "},
      {"consistency", "A NEES of 2 is right; above it the method is too sure of itself. "},
      {"error_over_time_", "Over time: means over the runs, up to the end of the shortest. "}};
  std::string notes;
  for (const Note& note : kNotes) {
    const bool is_there = std::any_of(charts.begin(), charts.end(), [&note](const NamedChart& named) {
      return named.name.rfind(note.chart, 0) == 0;
    });
    if (is_there) notes += note.text;
  }
  return notes;
}

std::string run_section(const EvalResults& results) {
  const std::vector<NamedChart> named = run_charts(results);
  if (named.empty()) return "";
  std::vector<Chart> charts;
  for (const NamedChart& chart : named) charts.push_back(chart.chart);
  return figures(charts) + paragraph(notes_on(named));
}

std::string sweep_section(const std::vector<SweepResult>& sweeps, const ReportContext& context) {
  if (sweeps.empty()) return "";
  std::vector<Chart> charts;
  for (const SweepResult& sweep : sweeps) charts.push_back(chart_of(sweep));
  return heading("One circumstance or setting varied at a time") +
         paragraph(
             fmt::format("Stock flights, scenario 1: {} runs a point and method. All else stays as it is, "
                         "settings {}; the dotted line is the usual value.",
                         cells_of(sweeps.front().points.front()).front().runs,
                         context.settings.empty() ? "at their defaults" : "as above")) +
         figures(charts);
}

std::string rendered_section(const std::vector<RenderedRun>& runs) {
  if (runs.empty()) return "";
  HtmlTable table;
  table.header = {"",      "frames", "found",     "extra", "RMSE m", "drawn detections: found",
                  "extra", "RMSE m", "RMSE ratio"};
  for (const RenderedRun& run : runs) {
    const Score &pictures = run.from_pictures.score, &model = run.from_model.score;
    table.rows.push_back(
        {fmt::format("scenario {}, {}", run.from_model.scenario, name_of(run.from_model.contender)),
         std::to_string(run.frames), fmt::format("{}/{}", pictures.found, pictures.targets),
         std::to_string(pictures.extra), three_decimals(pictures.rmse_m),
         fmt::format("{}/{}", model.found, model.targets), std::to_string(model.extra),
         three_decimals(model.rmse_m), two_decimals(rmse_ratio(run))});
  }
  return heading("With rendered pictures and the real detector") +
         paragraph(fmt::format(
             "{}: each frame drawn by the simulator's camera and searched by the detector that comes "
             "with geoloc, beside the same run with detections drawn from the noise model.",
             io::escape_markup(runs.front().from_model.flight))) +
         to_html(table);
}

std::string context_section(const ReportContext& context) {
  std::string html =
      paragraph(fmt::format("<code>{}</code><br>{}, geoloc {}", io::escape_markup(context.command),
                            context.made_at, context.version));
  if (context.settings.empty()) return html + paragraph("All settings of the estimator are the defaults.");
  std::string list;
  for (const std::string& setting : context.settings) list += io::escape_markup(setting) + "\n";
  return html + paragraph("Settings of the estimator that are not the defaults:") + "<pre>" + list +
         "</pre>\n";
}

}  // namespace

std::string to_html(const EvalResults& results, const ReportContext& context) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>geoloc: "
      "evaluation</title>\n"
      "<style>\n";
  html += std::string(io::palette_css()) + kPageStyle + chart_css() +
          "</style></head>\n<body><main>\n<h1>How well geoloc locates</h1>\n";
  html +=
      "<p class=\"lead\">Recorded ArduPilot flights, simulated camera. <b>paper</b> is the published method, "
      "<b>joint</b> "
      "the self-calibrating one. Frames are late and the camera is mounted askew, which the defaults do not "
      "tell either method.</p>\n";
  html += context_section(context);
  if (!results.runs.empty()) html += table_section(results.runs);
  html += run_section(results);
  html += sweep_section(results.sweeps, context);
  html += rendered_section(results.rendered);
  return html + "</main></body></html>\n";
}

}  // namespace geoloc::apps
