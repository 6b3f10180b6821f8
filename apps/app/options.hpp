// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/live_config.hpp"
#include "common/command_line.hpp"
#include "common/detector_options.hpp"
#include "common/run_outputs.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/mavlink/udp_socket.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// geoloc_app's command line.
struct LiveOptions {
  std::string udp = "14550";
  std::string rtsp_url;
  std::string video_file;
  std::string config_file;
  std::string method;
  DetectorOptions detector;
  std::string record_folder;
  std::string truth_file;
  bool print_config = false;
  bool print_settings = false;
  PriorFiles priors;
  OutputFiles outputs;
};

void add_live_options(CLI::App& program, LiveOptions& options);

/// The configuration file under the options. Throws std::runtime_error listing every fault.
LiveConfig load_config(const LiveOptions& options);

/// What a run is made of.
struct LiveInputs {
  LiveConfig config;
  std::vector<io::TrueTarget> truth;
  std::unique_ptr<io::Detector> detector;
  std::unique_ptr<io::UdpSocket> socket;
  std::unique_ptr<io::VideoSource> video;  ///< refers to the clock
};

/// Loads, binds and opens all of it. Throws std::runtime_error that lists everything that is wrong with
/// files, model, port and stream, each with its name and remedy.
LiveInputs open_inputs(const LiveOptions& options, const io::HostClock& clock);

}  // namespace geoloc::apps
