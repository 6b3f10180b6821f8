// SPDX-License-Identifier: Apache-2.0
#include "eval/eval_options.hpp"

#include <cstdio>
#include <stdexcept>

#include "common/command_line.hpp"
#include "common/ignored_settings.hpp"

namespace geoloc::apps {

void add_eval_options(CLI::App& program, EvalOptions& options) {
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
      ->check(whole_number())
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
  program
      .add_option("--sweep-setting", options.setting_sweeps,
                  "Vary one setting of the estimator as well, such as joint.gate=6,9,12; may be repeated")
      ->type_name("PATH=A,B,C")
      ->allow_extra_args(false);
  CLI::Option* const rendered = program.add_flag(
      "--rendered", options.is_rendered,
      "Also draw every frame of one flight and let the detector find the targets; takes minutes");
  program.add_option("--rendered-flight", options.rendered.flight, "Which one")->capture_default_str();
  program.add_option("--rendered-s", options.rendered.length_s, "So much of its survey, s [all]")
      ->check(CLI::Range(1.0, 1e4));
  add_detector_options(program, options.detector);
  for (const char* name :
       {"--rendered-flight", "--rendered-s", "--model", "--class-names", "--second-look", "--backend"})
    program.get_option(name)->needs(rendered);
  program.add_option("--config", options.config_file, "Settings of the estimator, JSON")->type_name("FILE");
  program.add_option("--report", options.report_folder, "Write report.md, report.json and pictures here")
      ->type_name("DIR");
  program.add_option("--data-dir", options.data_folder, "Folder of the flights [found beside the program]");
  program.add_option("--threads", options.threads, "Runs at once")
      ->check(CLI::Range(1U, 256U))
      ->capture_default_str();
}

void refuse_idle_options(const CLI::App& program, const EvalOptions& options) {
  std::string faults;
  const auto needs = [&](const char* name, bool has_effect, const char* what) {
    if (program.count(name) == 0 || has_effect) return;
    faults += (faults.empty() ? "" : "\n") + std::string(name) + ": without effect, since it needs " + what;
  };
  const bool has_table = options.flights != "none";
  needs("--dem-spacing-m", options.ground.ground == "dem", "--ground dem");
  needs("--scenarios", has_table || options.is_rendered, "flights (not --flights none) or --rendered");
  needs("--known-points", has_table, "flights (not --flights none)");
  const bool is_free = options.ground.ground == kFreeGround;
  needs("--ground", !is_free || options.method != "paper", "the joint method");
  needs("--ground-sigma-m", options.method != "paper", "the joint method");
  const bool has_sweep = !options.sweep.empty() || !options.setting_sweeps.empty();
  needs("--flights", has_table || has_sweep || options.is_rendered,
        "something else to do: --sweep, --sweep-setting or --rendered");
  if (!faults.empty()) throw std::runtime_error(faults);
}

EstimationConfig read_settings(const EvalOptions& options) {
  EstimationConfig config;
  if (options.config_file.empty()) return config;
  const nlohmann::json document = read_config_document(options.config_file);
  std::vector<std::string> problems;
  estimation_from_json(document, {"video", "detection"}, config, problems);
  refuse_problems(options.config_file, problems);
  std::vector<Ignored> ignored{
      {"method", "--method chooses it"},
      {"camera", "the camera is a simulated one"},
      {"video", "there is no video"},
      {"detection", "detections are drawn from a model, or found with default settings"},
      {"live_page", "there is no --http"},
      {"cot", "there is no --cot"}};
  if (options.method == "paper") ignored.push_back({"joint", "the method is paper"});
  if (options.method == "joint") ignored.push_back({"paper", "the method is joint"});
  const EstimationConfig defaults;
  for (const std::string& line :
       ignored_settings(document, estimation_to_json(defaults), ignored, options.config_file))
    std::fprintf(stderr, "geoloc_eval: %s\n", line.c_str());
  config.geolocator.method = defaults.geolocator.method;
  config.geolocator.camera = defaults.geolocator.camera;
  return config;
}

}  // namespace geoloc::apps
