// SPDX-License-Identifier: Apache-2.0
// Replays a recording: the same objects, the same bytes, every time.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <optional>

#include "common/command_line.hpp"
#include "common/estimation_config.hpp"
#include "common/outputs.hpp"
#include "common/progress.hpp"
#include "common/replay.hpp"
#include "common/run_outputs.hpp"
#include "geoloc/io/recording/recording_reader.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

struct Options {
  std::string recording;
  std::string method;
  std::string config_file;
  std::string truth_file;
  bool keep_going = false;
  bool print_config = false;
  PriorFiles priors;
  OutputFiles outputs;
};

/// The sections that only a live run has; a recording's config.json holds them too.
const std::vector<std::string> kLiveSections{"video", "detection"};

void apply(const nlohmann::json& document, const std::string& name, EstimationConfig& config) {
  std::vector<std::string> problems;
  estimation_from_json(document, kLiveSections, config, problems);
  refuse_problems(name, problems);
}

/// The recording's own configuration, under the file given, under the options given. The camera is always the
/// recording's, unless a file names another.
EstimationConfig choose_config(const Options& options, const io::Recording* recording) {
  EstimationConfig config;
  if (recording != nullptr && recording->config_json) {
    apply(nlohmann::json::parse(*recording->config_json, nullptr, false), options.recording + "/config.json",
          config);
  }
  if (recording != nullptr) config.geolocator.camera = recording->camera;
  if (!options.config_file.empty())
    apply(read_config_document(options.config_file), options.config_file, config);
  if (!options.method.empty()) apply({{"method", options.method}}, "--method", config);
  apply_priors(options.priors, config.geolocator);
  return config;
}

void add_options(CLI::App& program, Options& options) {
  program.add_option("recording", options.recording, "Folder of a recording")->type_name("RECORDING");
  program.add_option("--method", options.method, "full, or paper")->type_name("NAME");
  program.add_option("--config", options.config_file, "Settings, JSON (see --print-config)")
      ->type_name("FILE");
  program.add_option("--truth", options.truth_file, "True targets, GeoJSON; default: the recording's own")
      ->type_name("FILE");
  program.add_flag("--keep-going", options.keep_going, "Skip bad lines of frames.jsonl, and count them");
  program.add_flag("--print-config", options.print_config, "Print the settings as JSON, and exit");
  add_prior_options(program, options.priors);
  add_output_options(program, options.outputs);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Replays a recording of geoloc_app or geoloc_sim and writes the objects found.",
                   "geoloc_replay");
  Options options;
  add_options(program, options);
  if (const auto status = parse(program, argc, argv)) return *status;
  std::signal(SIGPIPE, SIG_IGN);  // a reader that went is an output's error, not the replay's end

  std::optional<io::Recording> recording;
  std::optional<Session> session;
  std::optional<Outputs> outputs;
  std::vector<io::TrueTarget> truth;
  const auto unusable = guard("geoloc_replay", kUnusable, [&] {
    if (options.recording.empty() && !options.print_config)
      throw std::runtime_error("name a RECORDING; see --help");
    if (!options.recording.empty()) {
      recording = io::read_recording(options.recording,
                                     options.keep_going ? io::BadLines::kSkip : io::BadLines::kRefuse);
    }
    const EstimationConfig config = choose_config(options, recording ? &*recording : nullptr);
    if (options.print_config) {
      std::puts(estimation_to_json(config).dump(2).c_str());
      return;
    }
    truth = options.truth_file.empty() ? recording->truth : io::read_truth(options.truth_file);
    session.emplace(config);
    // A replay is faster than its sinks, so it waits for them.
    outputs.emplace(recording->class_names, io::SinkRunnerConfig{256, io::WhenFull::kWait});
    add_sinks(options.outputs, config, *outputs);
  });
  if (unusable) return *unusable;
  if (options.print_config) return kDone;

  if (recording->skipped_lines > 0)
    std::fprintf(stderr, "geoloc_replay: skipped %zu bad lines\n", recording->skipped_lines);
  const std::size_t frames = recording->frames.size();
  ProgressLine progress("replaying", frames);
  std::size_t done = 0;
  replay(recording->telemetry, recording->frames, *session, [&](const PendingFrame& frame, bool is_located) {
    outputs->frame(*session, frame, is_located);
    progress.show(++done);
  });
  progress.finish();

  const io::RunRecord record = record_run(*session, recording->class_names, truth, options.recording);
  outputs->finish(record);
  for (const std::string& message : outputs->take_messages())
    std::fprintf(stderr, "geoloc_replay: %s\n", message.c_str());
  if (!options.outputs.has_objects()) std::fputs(objects_to_table(record.objects).c_str(), stdout);
  std::fprintf(stderr, "%s\n", record.summary.c_str());
  return outputs->has_failed() ? kFailed : kDone;
}
