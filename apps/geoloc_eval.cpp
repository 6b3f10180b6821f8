// SPDX-License-Identifier: Apache-2.0
// The paper's experiment on recorded flights: how many targets are found, and how far off they are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "common/command_line.hpp"
#include "common/detector_options.hpp"
#include "common/ground_options.hpp"
#include "common/progress_line.hpp"
#include "eval/experiment.hpp"
#include "eval/report_folder.hpp"
#include "eval/sweep.hpp"
#include "geoloc/sim/flight/flight.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

struct Options {
  std::string flights = "all";
  std::string method = "both";
  std::vector<int> scenarios{1, 2, 3};
  std::vector<std::uint64_t> seeds{0, 1, 2};
  int known_points = 0;
  double hills_m = 0.0;
  bool has_rangefinder = false;
  GroundOptions ground;
  double dem_spacing_m = 5.0;
  std::string config_file;
  std::string sweep;
  bool is_rendered = false;
  RenderedSettings rendered;
  DetectorOptions detector;
  std::string report_folder;
  std::optional<std::filesystem::path> data_folder;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

void add_options(CLI::App& program, Options& options) {
  program.add_option("--flights", options.flights, "Which set of flights in the table")
      ->check(CLI::IsMember({"stock", "gnss", "all", "none"}))
      ->capture_default_str();
  program.add_option("--method", options.method, "Which estimator")
      ->check(CLI::IsMember({"paper", "joint", "both"}))
      ->capture_default_str();
  program.add_option("--scenarios", options.scenarios, "Targets: 1 spread, 2 tight clusters, 3 grid")
      ->delimiter(',')
      ->check(CLI::Range(1, 3))
      ->capture_default_str();
  program.add_option("--seeds", options.seeds, "Seeds of targets and errors")
      ->delimiter(',')
      ->capture_default_str();
  program
      .add_option("--known-points", options.known_points,
                  "Also run the joint method with so many targets of each run told to it, 5 cm off; the "
                  "others are scored")
      ->check(CLI::Range(0, 30))
      ->capture_default_str();
  program.add_option("--hills-m", options.hills_m, "Amplitude of the ground's waves in the table's runs, m")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  program
      .add_option(
          "--ground", options.ground.ground,
          "What the estimator is told of the ground: plane, free, or dem, the simulated ground itself")
      ->check(CLI::IsMember({kLevelGround, kFreeGround, "dem"}))
      ->capture_default_str();
  program.add_flag("--rangefinder", options.has_rangefinder,
                   "The vehicles measure the distance to the ground below them");
  program.add_option("--dem-spacing-m", options.dem_spacing_m, "Between the heights that dem tells, m")
      ->check(CLI::Range(0.5, 100.0))
      ->capture_default_str();
  add_ground_sigma_option(program, options.ground);
  program.add_option("--sweep", options.sweep, "Vary one circumstance as well: its name, or all [none]")
      ->type_name("NAME");
  program.add_flag(
      "--rendered", options.is_rendered,
      "Also draw every frame of one flight and let the detector find the targets; takes minutes");
  program.add_option("--rendered-flight", options.rendered.flight, "Which one")->capture_default_str();
  program.add_option("--rendered-s", options.rendered.length_s, "So much of its survey, s [all]")
      ->check(CLI::Range(1.0, 1e4));
  add_detector_options(program, options.detector);
  program.add_option("--config", options.config_file, "Settings of the estimator, JSON")->type_name("FILE");
  program.add_option("--report", options.report_folder, "Write report.md, report.json and pictures here")
      ->type_name("DIR");
  program.add_option("--data-dir", options.data_folder, "Folder of the flights [found beside the program]");
  program.add_option("--threads", options.threads, "Runs at once")
      ->check(CLI::Range(1U, 256U))
      ->capture_default_str();
}

std::vector<std::string> flights_of_set(const std::string& set) {
  std::vector<std::string> flights;
  for (int path = 1; path <= 6; ++path) flights.push_back(set + "_path" + std::to_string(path));
  return flights;
}

/// Without flights: table and sweeps fly different ones.
Experiment make_experiment(const Options& options) {
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
  if (!options.config_file.empty()) {
    std::vector<std::string> problems;
    estimation_from_json(read_config_document(options.config_file), {"video", "detection"},
                         experiment.estimation, problems);
    refuse_problems(options.config_file, problems);
  }
  apply_ground_sigma(options.ground, experiment.estimation.geolocator);
  return experiment;
}

std::vector<RunResult> run_table(Experiment experiment, const Options& options) {
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
                                    const Options& options) {
  experiment.flights = flights_of_set("stock");
  std::size_t steps = 0;
  for (const Sweep& sweep : sweeps) steps += sweep.values.size() * experiment.flights.size();
  ProgressLine progress("sweeps", steps);
  auto results = run_sweeps(experiment, sweeps, options.threads,
                            [&](std::size_t done, std::size_t) { progress.show(done); });
  progress.finish();
  return results;
}

std::vector<RenderedRun> run_rendered(const Experiment& experiment, const Options& options) {
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
  Options options;
  add_options(program, options);
  if (const auto status = parse(program, argc, argv)) return *status;

  Experiment experiment;
  std::vector<Sweep> sweeps;
  const auto unusable = guard("geoloc_eval", kUnusable, [&] {
    experiment = make_experiment(options);
    if (!options.sweep.empty()) sweeps = find_sweeps(options.sweep);
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
    if (!options.report_folder.empty()) write_report(options.report_folder, results);
  });
  return failed.value_or(kDone);
}
