// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/live_config.hpp"
#include "common/run_outputs.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// geoloc_app's command line.
struct LiveOptions {
  std::string udp = "14550";
  std::string rtsp_url;
  std::string video_file;
  std::string config_file;
  std::string method;
  std::string model_file;
  std::string class_names_file;
  std::string backend = "opencv";
  std::string record_folder;
  std::string truth_file;
  bool print_config = false;
  OutputFiles outputs;
};

void add_live_options(CLI::App& program, LiveOptions& options);

/// The configuration file under the options. Throws std::runtime_error listing every fault.
LiveConfig load_config(const LiveOptions& options);

/// Throws std::runtime_error or std::invalid_argument naming the model and the remedy.
std::unique_ptr<io::Detector> make_detector(const LiveOptions& options, const io::DetectionConfig& config);

/// Throws where neither or both of --rtsp and --video are given, or the file cannot be played.
std::unique_ptr<io::VideoSource> make_video_source(const LiveOptions& options, const io::VideoConfig& config,
                                                   const io::HostClock& clock);

}  // namespace geoloc::apps
