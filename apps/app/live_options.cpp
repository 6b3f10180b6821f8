// SPDX-License-Identifier: Apache-2.0
#include "app/live_options.hpp"

namespace geoloc::apps {

void add_live_options(CLI::App& program, LiveOptions& options) {
  const auto add = [&program](const char* name, std::string& value, const char* help, const char* type) {
    return program.add_option(name, value, help)->type_name(type);
  };
  add("--udp", options.udp, "MAVLink input: PORT on every interface, or HOST:PORT", "[HOST:]PORT")
      ->capture_default_str();
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

LoadedConfig load_config(const LiveOptions& options) {
  LoadedConfig loaded;
  LiveConfig& config = loaded.config;
  const auto apply = [&config](const nlohmann::json& document, const std::string& name) {
    std::vector<std::string> problems;
    live_from_json(document, config, problems);
    refuse_problems(name, problems);
  };
  if (!options.config_file.empty()) apply(read_config_document(options.config_file), options.config_file);
  if (!options.method.empty()) apply({{"method", options.method}}, "--method");
  apply_priors(options.priors, config.estimation.geolocator);
  loaded.remarks = apply_ground(options.ground, config.estimation.geolocator);
  config.detection = with_backend(options.detector, config.detection);
  return loaded;
}

}  // namespace geoloc::apps
