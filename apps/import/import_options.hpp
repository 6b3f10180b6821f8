// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/detector_options.hpp"

namespace geoloc::apps {

/// `geoloc_import stills`.
struct StillsOptions {
  std::vector<std::string> inputs;
  std::string out;
  std::string labels_file;
  std::string camera_file;
  std::optional<double> utc_offset_h;
  std::optional<double> take_off_height_m;
  std::optional<double> gimbal_pitch_deg;
  DetectorOptions detector;
  DetectorTuning tuning;
};

void add_stills_command(CLI::App& program, StillsOptions& options);

/// `geoloc_import video`.
struct VideoOptions {
  std::string video;
  std::string log;
  std::string out;
  std::string labels_file;
  std::string camera_file;
  std::string log_offset = "auto";  ///< or a number of seconds
  std::optional<double> utc_offset_h;
  std::optional<double> take_off_height_m;
  std::optional<double> gimbal_pitch_deg;
  DetectorOptions detector;
  DetectorTuning tuning;
};

/// The subcommand, for parsed().
const CLI::App* add_video_command(CLI::App& program, VideoOptions& options);

}  // namespace geoloc::apps
