// SPDX-License-Identifier: Apache-2.0
#include "app/live_options.hpp"

#include "common/ignored_settings.hpp"

namespace geoloc::apps {

void add_live_options(CLI::App& program, LiveOptions& options) {
  const auto add = [&program](const char* name, std::string& value, const char* help, const char* type) {
    return program.add_option(name, value, help)->type_name(type);
  };
  add("--udp", options.udp,
      "MAVLink input: PORT on every interface, or HOST:PORT; without it, telemetry in the video goes first",
      "[HOST:]PORT")
      ->capture_default_str()
      ->each([&options](const std::string&) { options.is_udp_given = true; });
  add("--rtsp", options.rtsp_url, "Camera stream, H.264", "URL");
  add("--video", options.video_file, "A video file in place of a stream, played in real time", "FILE");
  add("--config", options.config_file, "Settings, JSON (see --print-config)", "FILE");
  add("--method", options.method, "joint, or paper", "NAME");
  add_detector_options(program, options.detector);
  add("--record", options.record_folder, "Record telemetry and detections, for geoloc_replay", "DIR");
  add("--truth", options.truth_file, "True targets, GeoJSON: the run is scored at its end", "FILE");
  program.add_flag("--print-config", options.print_config, "Print the settings as JSON, and exit");
  program.add_flag("--print-settings", options.print_settings,
                   "Print each setting's default, range, unit and meaning as a table, and exit");
  program.add_flag("--time-detector", options.time_detector,
                   "Print how long the detector takes for a picture on this computer, and exit");
  add_prior_options(program, options.priors);
  add_ground_options(program, options.ground);
  add_output_options(program, options.outputs);
}

NamedFiles inputs_of(const LiveOptions& options) {
  NamedFiles files = joined({files_of_config(options.config_file), files_of(options.detector),
                             files_of(options.priors), files_of(options.ground), inputs_of(options.outputs)});
  add_named(files, "--video", options.video_file);
  add_named(files, "--truth", options.truth_file);
  return files;
}

namespace {

/// Lines on the settings of the file that change nothing.
std::string ignored_lines(const LiveOptions& options, const nlohmann::json& document,
                          const LiveConfig& config) {
  std::vector<Ignored> ignored = ignored_by(config.estimation, options.outputs);
  for (const char* setting : {"transport", "latency_s", "reorder_s", "frame_timeout_s", "connect_timeout_s",
                              "retry_min_s", "retry_max_s"}) {
    if (options.rtsp_url.empty()) ignored.push_back({std::string("video.") + setting, "there is no --rtsp"});
  }
  const LiveConfig defaults;
  std::string lines;
  for (const std::string& line :
       ignored_settings(document, live_to_json(defaults), ignored, options.config_file))
    lines += (lines.empty() ? "" : "\n") + line;
  return lines;
}

}  // namespace

LoadedConfig load_config(const LiveOptions& options) {
  LoadedConfig loaded;
  LiveConfig& config = loaded.config;
  const auto apply = [&config](const nlohmann::json& document, const std::string& name) {
    std::vector<std::string> problems;
    live_from_json(document, config, problems);
    refuse_problems(name, problems);
  };
  nlohmann::json document;
  if (!options.config_file.empty()) {
    document = read_config_document(options.config_file);
    apply(document, options.config_file);
  }
  if (!options.method.empty()) apply({{"method", options.method}}, "--method");
  apply_priors(options.priors, config.estimation.geolocator);
  loaded.remarks = ignored_lines(options, document, config);
  if (const std::string ground = apply_ground(options.ground, config.estimation.geolocator); !ground.empty())
    loaded.remarks += (loaded.remarks.empty() ? "" : "\n") + ground;
  config.detection = with_backend(options.detector, config.detection);
  return loaded;
}

LiveConfig config_to_print(const LiveOptions& options) {
  LiveConfig config = load_config(options).config;
  if (!options.detector.model_file.empty())
    config.detection = io::with_model_defaults(detector_files(options.detector), config.detection);
  return config;
}

}  // namespace geoloc::apps
