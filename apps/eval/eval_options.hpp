// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/detector_options.hpp"
#include "common/estimation_config.hpp"
#include "common/ground_options.hpp"
#include "eval/rendered_run.hpp"

namespace geoloc::apps {

/// geoloc_eval's command line.
struct EvalOptions {
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
  std::vector<std::string> setting_sweeps;
  bool is_rendered = false;
  RenderedSettings rendered;
  DetectorOptions detector;
  std::string report_folder;
  std::optional<std::filesystem::path> data_folder;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

void add_eval_options(CLI::App& program, EvalOptions& options);

/// Throws std::runtime_error that lists the options without effect, each with what it would need.
void refuse_idle_options(const CLI::App& program, const EvalOptions& options);

/// The settings of --config over the defaults. Those without effect are named on stderr.
EstimationConfig read_settings(const EvalOptions& options);

}  // namespace geoloc::apps
