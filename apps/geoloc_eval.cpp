// SPDX-License-Identifier: Apache-2.0
// The paper's experiment on recorded flights: how many targets are found, and how far off they are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "common/command_line.hpp"
#include "common/progress_line.hpp"
#include "eval/eval_options.hpp"
#include "eval/experiment.hpp"
#include "eval/report_folder.hpp"
#include "eval/setting_sweep.hpp"
#include "eval/sweep.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/sim/flight/flight.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

std::vector<std::string> flights_of_set(const std::string& set) {
  std::vector<std::string> flights;
  for (int path = 1; path <= 6; ++path) flights.push_back(set + "_path" + std::to_string(path));
  return flights;
}

/// Without flights: table and sweeps fly different ones.
Experiment make_experiment(const EvalOptions& options) {
  Experiment experiment;
  experiment.flights_folder =
      sim::find_flights(options.data_folder, std::filesystem::read_symlink("/proc/self/exe"));
  if (options.method == "paper") experiment.contenders = {{Method::kPaper, 0}};
  if (options.method == "joint") experiment.contenders = {{Method::kJoint, 0}};
  if (options.known_points > 0) experiment.contenders.push_back({Method::kJoint, options.known_points});
  experiment.scenarios = options.scenarios;
  experiment.seeds = options.seeds;
  experiment.recording.terrain.hills_m = options.hills_m;
  experiment.has_rangefinder = options.has_rangefinder;
  if (options.ground.ground == "dem") experiment.dem_spacing_m = options.dem_spacing_m;
  experiment.estimation = read_settings(options);
  apply_ground_sigma(options.ground, experiment.estimation.geolocator);
  return experiment;
}

std::vector<RunResult> run_table(Experiment experiment, const EvalOptions& options) {
  for (const char* set : {"stock", "gnss"}) {
    if (options.flights != "all" && options.flights != set) continue;
    for (std::string& flight : flights_of_set(set)) experiment.flights.push_back(std::move(flight));
  }
  ProgressLine progress("runs",
                        experiment.flights.size() * experiment.scenarios.size() * experiment.seeds.size());
  const auto results = run_experiment(experiment, options.threads,
                                      [&](std::size_t done, std::size_t) { progress.show(done); });
  progress.finish();
  return results;
}

std::vector<SweepResult> run_sweeps(Experiment experiment, const std::vector<Sweep>& sweeps,
                                    const EvalOptions& options) {
  experiment.flights = flights_of_set("stock");
  std::size_t steps = 0;
  for (const Sweep& sweep : sweeps) steps += sweep.values.size() * experiment.flights.size();
  ProgressLine progress("sweeps", steps);
  auto results = run_sweeps(experiment, sweeps, options.threads,
                            [&](std::size_t done, std::size_t) { progress.show(done); });
  progress.finish();
  return results;
}

std::vector<RenderedRun> run_rendered(const Experiment& experiment, const EvalOptions& options) {
  RenderedSettings settings = options.rendered;
  settings.seed = options.seeds.front();
  if (!options.report_folder.empty()) {
    settings.recordings = std::filesystem::path(options.report_folder) / "rendered";
    std::filesystem::create_directories(settings.recordings);
  }
  std::optional<ProgressLine> progress;
  auto runs = run_rendered(experiment, settings, options.threads, [&](std::size_t done, std::size_t total) {
    if (!progress) progress.emplace("pictures", total);
    progress->show(done);
  });
  if (progress) progress->finish();
  return runs;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Runs the estimator on all flights and scenarios, and scores it.", "geoloc_eval");
  EvalOptions options;
  add_eval_options(program, options);
  if (const auto status = parse(program, argc, argv)) return *status;

  ReportContext context{command_of(argc, argv), io::iso8601(io::HostClock().now()), version(), {}};
  Experiment experiment;
  std::vector<Sweep> sweeps;
  const auto unusable = guard("geoloc_eval", kUnusable, [&] {
    refuse_idle_options(program, options);
    experiment = make_experiment(options);
    if (!options.sweep.empty()) sweeps = find_sweeps(options.sweep);
    for (const std::string& text : options.setting_sweeps)
      sweeps.push_back(setting_sweep(text, experiment.estimation));
    context.settings = changed_settings(experiment.estimation);
    if (options.is_rendered) {
      sim::load_flight(experiment.flights_folder, options.rendered.flight);  // refuses an unknown one
      options.rendered.model = detector_files(options.detector);
      options.rendered.detection = with_backend(options.detector, {});
      io::open_detector(options.rendered.model, options.rendered.detection);  // refuses an unusable one
    }
    if (!options.report_folder.empty())
      check_report_folder(options.report_folder,
                          joined({files_of_config(options.config_file), files_of(options.detector)}));
  });
  if (unusable) return *unusable;

  const auto failed = guard("geoloc_eval", kFailed, [&] {
    EvalResults results;
    results.runs = run_table(experiment, options);
    results.sweeps = run_sweeps(experiment, sweeps, options);
    if (options.is_rendered) results.rendered = run_rendered(experiment, options);
    std::fputs(to_markdown(results).c_str(), stdout);
    if (!options.report_folder.empty()) write_report(options.report_folder, results, context);
  });
  return failed.value_or(kDone);
}
