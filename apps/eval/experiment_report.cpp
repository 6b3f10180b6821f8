// SPDX-License-Identifier: Apache-2.0
#include "eval/experiment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eval/mean.hpp"

namespace geoloc::apps {
namespace {

Summary& summary_of(std::vector<Summary>& summaries, const RunResult& run) {
  const std::string set = set_of(run.flight);
  for (Summary& summary : summaries) {
    if (summary.set == set && summary.contender == run.contender) return summary;
  }
  summaries.push_back({});
  summaries.back().set = set;
  summaries.back().contender = run.contender;
  return summaries.back();
}

void add_calibration(Summary& summary, const CalibrationError& error) {
  const double latency_s = std::abs(error.latency_s);
  summary.worst_latency_error_s = std::max(summary.worst_latency_error_s, latency_s);
  summary.worst_sigmas = std::max(summary.worst_sigmas, latency_s / error.sigma_latency_s);
  for (int axis = 0; axis < 2; ++axis) {
    const double boresight_deg = std::abs(error.boresight_deg[axis]);
    summary.worst_boresight_error_deg = std::max(summary.worst_boresight_error_deg, boresight_deg);
    summary.worst_sigmas = std::max(summary.worst_sigmas, boresight_deg / error.sigma_boresight_deg[axis]);
  }
  if (error.focal_percent)
    summary.worst_sigmas =
        std::max(summary.worst_sigmas, std::abs(*error.focal_percent) / error.sigma_focal_percent);
}

nlohmann::ordered_json to_json(const std::optional<CalibrationError>& error) {
  if (!error) return nullptr;
  nlohmann::ordered_json json{{"latency_s", error->latency_s},
                              {"sigma_latency_s", error->sigma_latency_s},
                              {"boresight_x_deg", error->boresight_deg.x()},
                              {"boresight_y_deg", error->boresight_deg.y()},
                              {"sigma_boresight_x_deg", error->sigma_boresight_deg.x()},
                              {"sigma_boresight_y_deg", error->sigma_boresight_deg.y()}};
  if (error->focal_percent) {
    json["focal_percent"] = *error->focal_percent;
    json["sigma_focal_percent"] = error->sigma_focal_percent;
  }
  return json;
}

std::vector<std::string> flights_of(const std::vector<RunResult>& results, const std::string& set) {
  std::vector<std::string> flights;
  for (const RunResult& run : results) {
    if (set_of(run.flight) == set && (flights.empty() || flights.back() != run.flight))
      flights.push_back(run.flight);
  }
  return flights;
}

bool is_same_run(const RunResult& a, const RunResult& b) {
  return a.flight == b.flight && a.scenario == b.scenario && a.seed == b.seed;
}

}  // namespace

std::string set_of(const std::string& flight) {
  return flight.substr(0, flight.find('_'));
}

std::string name_of(const Contender& contender) {
  if (contender.method == Method::kPaper) return "paper";
  return contender.known_points == 0 ? "joint"
                                     : fmt::format("joint, {} known points", contender.known_points);
}

std::string three_decimals(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "–";
}

std::string two_decimals(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "–";
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string table_cell(const std::vector<RunResult>& results, const std::string& flight, int scenario,
                       const Contender& contender) {
  Mean rmse_m;
  double found = 0.0;
  int runs = 0;
  for (const RunResult& run : results) {
    if (run.flight != flight || run.scenario != scenario || !(run.contender == contender)) continue;
    ++runs;
    rmse_m.add(run.score.rmse_m);
    found += run.score.found;
  }
  return runs == 0 ? "" : fmt::format("{} / {:.3g}", three_decimals(rmse_m.value()), found / runs);
}

std::vector<Summary> summarize(const std::vector<RunResult>& results) {
  struct Means {
    Mean rmse_m, relative_rmse_m, nees;
  };
  std::vector<Summary> summaries;
  std::vector<Means> means;
  for (const RunResult& run : results) {
    Summary& summary = summary_of(summaries, run);
    means.resize(summaries.size());
    Means& mean = means[static_cast<std::size_t>(&summary - summaries.data())];
    ++summary.runs;
    mean.rmse_m.add(run.score.rmse_m);
    mean.relative_rmse_m.add(run.score.relative_rmse_m);
    if (run.score.found > 0) mean.nees.add(run.nees);
    summary.found += run.score.found;
    summary.targets += run.score.targets;
    summary.extra += run.score.extra;
    summary.merged_pairs += run.score.merged_pairs;
    if (run.heights) summary.mean_relative_height_rmse_m += run.heights->relative_rmse_m;
    if (run.calibration) add_calibration(summary, *run.calibration);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    Summary& summary = summaries[i];
    summary.mean_rmse_m = means[i].rmse_m.value();
    summary.mean_relative_rmse_m = means[i].relative_rmse_m.value();
    summary.mean_nees = means[i].nees.value();
    summary.mean_relative_height_rmse_m /= summary.runs;
  }
  return summaries;
}

std::string to_markdown(const std::vector<RunResult>& results) {
  const std::vector<Summary> summaries = summarize(results);
  std::string text =
      "| set | method | runs | RMSE m | relative RMSE m | found | extra | merged pairs | NEES (2 is right) | "
      "worst latency error s | worst boresight error deg | in stated sigmas | relative height RMSE m |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  const auto out = std::back_inserter(text);
  for (const Summary& s : summaries) {
    fmt::format_to(
        out, "| {} | {} | {} | {} | {} | {}/{} | {} | {} | {} | {:.3f} | {:.2f} | {:.1f} | {:.3f} |\n", s.set,
        name_of(s.contender), s.runs, three_decimals(s.mean_rmse_m), three_decimals(s.mean_relative_rmse_m),
        s.found, s.targets, s.extra, s.merged_pairs, two_decimals(s.mean_nees), s.worst_latency_error_s,
        s.worst_boresight_error_deg, s.worst_sigmas, s.mean_relative_height_rmse_m);
  }
  for (const Summary& s : summaries) {
    fmt::format_to(out, "\n{}, {}: RMSE m / targets found, means over the seeds\n\n", s.set,
                   name_of(s.contender));
    text += "| flight | scenario 1 | scenario 2 | scenario 3 |\n|---|---|---|---|\n";
    for (const std::string& flight : flights_of(results, s.set)) {
      fmt::format_to(out, "| {} | {} | {} | {} |\n", flight, table_cell(results, flight, 1, s.contender),
                     table_cell(results, flight, 2, s.contender),
                     table_cell(results, flight, 3, s.contender));
    }
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<RunResult>& results) {
  auto runs = nlohmann::ordered_json::array();
  for (const RunResult& run : results) {
    runs.push_back({{"flight", run.flight},
                    {"scenario", run.scenario},
                    {"seed", run.seed},
                    {"method", name_of(run.contender)},
                    {"rmse_m", number_or_null(run.score.rmse_m)},
                    {"relative_rmse_m", number_or_null(run.score.relative_rmse_m)},
                    {"found", run.score.found},
                    {"targets", run.score.targets},
                    {"extra", run.score.extra},
                    {"merged_pairs", run.score.merged_pairs},
                    {"height_rmse_m", run.heights ? nlohmann::ordered_json(run.heights->rmse_m) : nullptr},
                    {"relative_height_rmse_m",
                     run.heights ? nlohmann::ordered_json(run.heights->relative_rmse_m) : nullptr},
                    {"nees", run.nees},
                    {"known_points_used", run.known_points_used},
                    {"known_points_mistaken", run.known_points_mistaken},
                    {"calibration_error", to_json(run.calibration)}});
  }
  auto summaries = nlohmann::ordered_json::array();
  for (const Summary& s : summarize(results)) {
    summaries.push_back({{"set", s.set},
                         {"method", name_of(s.contender)},
                         {"runs", s.runs},
                         {"mean_rmse_m", number_or_null(s.mean_rmse_m)},
                         {"mean_relative_rmse_m", number_or_null(s.mean_relative_rmse_m)},
                         {"found", s.found},
                         {"targets", s.targets},
                         {"extra", s.extra},
                         {"merged_pairs", s.merged_pairs},
                         {"mean_nees", number_or_null(s.mean_nees)},
                         {"mean_relative_height_rmse_m", s.mean_relative_height_rmse_m},
                         {"worst_latency_error_s", s.worst_latency_error_s},
                         {"worst_boresight_error_deg", s.worst_boresight_error_deg},
                         {"worst_error_in_sigmas", s.worst_sigmas}});
  }
  return {{"summaries", summaries}, {"runs", runs}};
}

std::vector<RunPair> pairs_of(const std::vector<RunResult>& runs) {
  std::vector<RunPair> pairs;
  for (const RunResult& paper : runs) {
    if (paper.contender.method != Method::kPaper) continue;
    const auto joint = std::find_if(runs.begin(), runs.end(), [&](const RunResult& run) {
      return run.contender == Contender{Method::kJoint, 0} && is_same_run(run, paper);
    });
    if (joint != runs.end() && paper.score.rmse_m && joint->score.rmse_m) pairs.push_back({&paper, &*joint});
  }
  return pairs;
}

}  // namespace geoloc::apps
