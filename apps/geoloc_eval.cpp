// SPDX-License-Identifier: Apache-2.0
// The paper's experiment on recorded flights: how many targets are found, and how far off they are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "common/command_line.hpp"
#include "common/progress.hpp"
#include "eval/experiment.hpp"
#include "eval/report.hpp"
#include "geoloc/io/atomic_file.hpp"
#include "geoloc/sim/flight.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

struct Options {
  std::string flights = "all";
  std::string method = "both";
  std::vector<std::uint64_t> seeds{0, 1, 2};
  int known_points = 0;
  std::string config_file;
  std::string report_folder;
  std::optional<std::filesystem::path> data_folder;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

void add_options(CLI::App& program, Options& options) {
  program.add_option("--flights", options.flights, "Which set of flights")
      ->check(CLI::IsMember({"stock", "gnss", "all"}))
      ->capture_default_str();
  program.add_option("--method", options.method, "Which estimator")
      ->check(CLI::IsMember({"paper", "full", "both"}))
      ->capture_default_str();
  program.add_option("--seeds", options.seeds, "Seeds of targets and errors")
      ->delimiter(',')
      ->capture_default_str();
  program
      .add_option("--known-points", options.known_points,
                  "Targets of each run that the full method is told, 5 cm off; the others are scored")
      ->check(CLI::Range(0, 30))
      ->capture_default_str();
  program.add_option("--config", options.config_file, "Settings of the estimator, JSON")->type_name("FILE");
  program.add_option("--report", options.report_folder, "Write report.md and report.json here")
      ->type_name("DIR");
  program.add_option("--data-dir", options.data_folder, "Folder of the flights [found beside the program]");
  program.add_option("--threads", options.threads, "Runs at once")
      ->check(CLI::Range(1U, 256U))
      ->capture_default_str();
}

Experiment make_experiment(const Options& options) {
  Experiment experiment;
  experiment.flights_folder =
      sim::find_flights(options.data_folder, std::filesystem::read_symlink("/proc/self/exe"));
  for (const char* set : {"stock", "gnss"}) {
    if (options.flights != "all" && options.flights != set) continue;
    for (int path = 1; path <= 6; ++path)
      experiment.flights.push_back(std::string(set) + "_path" + std::to_string(path));
  }
  if (options.method == "paper") experiment.methods = {Method::kPaper};
  if (options.method == "full") experiment.methods = {Method::kFull};
  experiment.seeds = options.seeds;
  experiment.known_points = options.known_points;
  if (!options.config_file.empty()) {
    std::vector<std::string> problems;
    estimation_from_json(read_config_document(options.config_file), {"video", "detection"},
                         experiment.estimation, problems);
    refuse_problems(options.config_file, problems);
  }
  return experiment;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Runs the estimator on all flights and scenarios, and scores it.", "geoloc_eval");
  Options options;
  add_options(program, options);
  if (const auto status = parse(program, argc, argv)) return *status;

  Experiment experiment;
  const auto unusable = guard("geoloc_eval", kUnusable, [&] { experiment = make_experiment(options); });
  if (unusable) return *unusable;

  const auto failed = guard("geoloc_eval", kFailed, [&] {
    ProgressLine progress("runs",
                          experiment.flights.size() * experiment.scenarios.size() * experiment.seeds.size());
    const auto results = run_experiment(experiment, options.threads,
                                        [&](std::size_t done, std::size_t) { progress.show(done); });
    progress.finish();
    std::fputs(to_markdown(results).c_str(), stdout);
    if (options.report_folder.empty()) return;
    const std::filesystem::path folder(options.report_folder);
    std::filesystem::create_directories(folder);
    io::write_file_atomically(folder / "report.md", to_markdown(results));
    io::write_file_atomically(folder / "report.json", to_json(results));
  });
  return failed.value_or(kDone);
}
