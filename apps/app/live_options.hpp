// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/live_config.hpp"
#include "common/detector_options.hpp"
#include "common/ground_options.hpp"
#include "common/output_options.hpp"
#include "common/prior_options.hpp"

namespace geoloc::apps {

/// geoloc_app's command line.
struct LiveOptions {
  std::string udp = "14550";
  bool is_udp_given = false;
  std::string rtsp_url;
  std::string video_file;
  std::string config_file;
  std::string method;
  DetectorOptions detector;
  std::string record_folder;
  std::string truth_file;
  bool print_config = false;
  bool print_settings = false;
  bool time_detector = false;
  PriorFiles priors;
  GroundOptions ground;
  OutputOptions outputs;
};

void add_live_options(CLI::App& program, LiveOptions& options);

/// Every file that a run reads, for check_outputs(). Throws std::runtime_error as load_config().
NamedFiles inputs_of(const LiveOptions& options);

struct LoadedConfig {
  LiveConfig config;
  std::string remarks;  ///< what the user should know of it; may be empty
};

/// The configuration file under the options. Throws std::runtime_error listing every fault.
LoadedConfig load_config(const LiveOptions& options);

/// The same for people: with what a model named on the command line decides. Without one it stays open, so
/// that the settings suit every model.
LiveConfig config_to_print(const LiveOptions& options);

}  // namespace geoloc::apps
