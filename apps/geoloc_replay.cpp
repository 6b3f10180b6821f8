// SPDX-License-Identifier: Apache-2.0
// Replays a recording: the same objects, the same bytes, every time.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "common/command_line.hpp"
#include "common/estimation_config.hpp"
#include "common/ground_options.hpp"
#include "common/ignored_settings.hpp"
#include "common/live_page_output.hpp"
#include "common/objects_table.hpp"
#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "common/prior_options.hpp"
#include "common/recorded_config.hpp"
#include "common/run_record.hpp"
#include "common/stop_signal.hpp"
#include "geoloc/io/recording/recording_reader.hpp"
#include "replay/late_notes.hpp"
#include "replay/replay_show.hpp"

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
  std::optional<double> speed;
  PriorFiles priors;
  GroundOptions ground;
  OutputOptions outputs;
};

/// Names the settings of the file that change nothing: those of the live run, of which the recording tells
/// what came of them, and those that other options leave without effect.
void tell_ignored(const Options& options, const nlohmann::json& document, nlohmann::json before,
                  const nlohmann::json& recorded, const EstimationConfig& config) {
  constexpr const char* kNoVehicle = "a replay sends nothing to a vehicle";
  std::vector<Ignored> ignored = ignored_by(config, options.outputs);
  for (const std::string& section : kLiveSections) {
    ignored.push_back({section, "a replay takes frames and detections as they were recorded"});
    if (recorded.is_object() && recorded.contains(section)) before[section] = recorded[section];
  }
  for (const char* setting : {"component_id", "attitude_rate_hz", "position_rate_hz", "rangefinder_rate_hz",
                              "gimbal_rate_hz", "link_timeout_s", "signing_key_file", "signing_state_file",
                              "camera", "camera_component_id", "status_text"})
    ignored.push_back({std::string("mavlink.") + setting, kNoVehicle});
  for (const std::string& line : ignored_settings(document, before, ignored, options.config_file))
    std::fprintf(stderr, "geoloc_replay: %s\n", line.c_str());
}

/// The recording's own configuration, under the file given, under the options given. The camera is always the
/// recording's, unless a file names another.
EstimationConfig choose_config(const Options& options, const io::Recording* recording) {
  EstimationConfig config;
  nlohmann::json recorded;
  if (recording != nullptr && recording->config_json) {
    recorded = recorded_settings(*recording->config_json);
    apply_settings(recorded, options.recording + "/config.json", config);
  }
  if (recording != nullptr) config.geolocator.camera = recording->camera;
  const nlohmann::json before = estimation_to_json(config);
  nlohmann::json document;
  if (!options.config_file.empty()) {
    document = read_config_document(options.config_file);
    apply_settings(document, options.config_file, config);
  }
  if (!options.method.empty()) apply_settings({{"method", options.method}}, "--method", config);
  tell_ignored(options, document, before, recorded, config);
  apply_priors(options.priors, config.geolocator);
  if (const std::string remarks = apply_ground(options.ground, config.geolocator); !remarks.empty())
    std::fprintf(stderr, "%s\n", remarks.c_str());
  return config;
}

/// Every file that a replay reads.
NamedFiles inputs_of(const Options& options) {
  NamedFiles files = joined({files_of_config(options.config_file), files_of(options.priors),
                             files_of(options.ground), inputs_of(options.outputs)});
  if (!options.recording.empty()) files = joined({files, files_of_recording(options.recording)});
  add_named(files, "--truth", options.truth_file);
  return files;
}

void add_options(CLI::App& program, Options& options) {
  program.add_option("recording", options.recording, "Folder of a recording")->type_name("RECORDING");
  program.add_option("--method", options.method, "joint, or paper")->type_name("NAME");
  program.add_option("--config", options.config_file, "Settings, JSON (see --print-config)")
      ->type_name("FILE");
  program.add_option("--truth", options.truth_file, "True targets, GeoJSON; default: the recording's own")
      ->type_name("FILE");
  program.add_flag("--keep-going", options.keep_going, "Skip bad lines of frames.jsonl, and count them");
  program.add_flag("--print-config", options.print_config, "Print the settings as JSON, and exit");
  program
      .add_option("--speed", options.speed,
                  "Times the recorded speed; 0: as fast as it computes. Default: 1 with --http, otherwise 0")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("X");
  add_prior_options(program, options.priors);
  add_ground_options(program, options.ground);
  add_output_options(program, options.outputs);
}

/// All that a replay is made of, once its arguments and files have proved usable.
struct Program {
  Program(const Options& given, io::Recording its_recording, EstimationConfig its_config)
      : options(given),
        config(std::move(its_config)),
        recording(std::move(its_recording)),
        truth(given.truth_file.empty() ? recording.truth : io::read_truth(given.truth_file)),
        playback(
            std::make_shared<io::ReplayControl>(begin_of(recording), end_of(recording), speed_of(given))),
        // A replay is faster than its sinks, so it waits for them.
        outputs(recording.class_names, io::SinkRunnerConfig{256, io::WhenFull::kWait}) {
    outputs.notes()->load(recording.notes);
    add_sinks(options.outputs, config, io::OldFile::kReplace, outputs);
    delivery = add_summary_publisher(options.outputs, config, outputs);
    page = open_live_page(options.outputs, options.ground, config.live_page, {options.recording, false},
                          recording.class_names, outputs, playback);
    if (page) {
      for (const auto& [id, jpeg] : recording.pictures) page->show_object(id, jpeg);
    }
    show.emplace(ShowSource{recording, config, truth, options.recording, options.outputs}, outputs,
                 page.get(), *playback);
  }

  static HostTime begin_of(const io::Recording& recording) {
    return recording.frames.empty() ? HostTime{} : recording.frames.front().captured_at;
  }
  static HostTime end_of(const io::Recording& recording) {
    return recording.frames.empty() ? HostTime{} : recording.frames.back().captured_at;
  }
  static double speed_of(const Options& options) {
    return options.speed.value_or(options.outputs.http.empty() ? 0.0 : 1.0);
  }

  void tell_all() {
    for (const std::string& message : outputs.take_messages())
      std::fprintf(stderr, "geoloc_replay: %s\n", message.c_str());
  }

  Options options;
  EstimationConfig config;
  io::Recording recording;
  std::vector<io::TrueTarget> truth;
  std::shared_ptr<io::ReplayControl> playback;
  Outputs outputs;
  std::shared_ptr<io::LivePage> page;                   ///< nullptr where none is wanted
  std::shared_ptr<const io::SummaryDelivery> delivery;  ///< to the fleet; nullptr where there is none
  std::optional<ReplayShow> show;
};

/// The program; empty after --print-config.
std::unique_ptr<Program> make_program(const Options& options) {
  if (options.recording.empty() && !options.print_config)
    throw std::runtime_error("name a RECORDING; see --help");
  std::optional<io::Recording> recording;
  if (!options.recording.empty()) {
    recording = io::read_recording(options.recording,
                                   options.keep_going ? io::BadLines::kSkip : io::BadLines::kRefuse);
  }
  const EstimationConfig config = choose_config(options, recording ? &*recording : nullptr);
  check_outputs(files_of(options.outputs), inputs_of(options));
  if (options.print_config) {
    std::puts(estimation_to_json(config).dump(2).c_str());
    return nullptr;
  }
  return std::make_unique<Program>(options, std::move(*recording), config);
}

void tell_skipped(const io::SkippedLines& skipped) {
  for (const std::string& line : skipped.named)
    std::fprintf(stderr, "geoloc_replay: skipped %s\n", line.c_str());
  if (skipped.count > 0) std::fprintf(stderr, "geoloc_replay: skipped %zu bad lines\n", skipped.count);
}

/// The page stays to be looked at, until Ctrl-C. Whether results could not be written again.
bool keep_page(Program& program, const io::RunRecord& record, const StopSignal& stop) {
  bool has_failed = false;
  if (!program.page) return has_failed;
  if (!stop.is_requested())
    std::fprintf(stderr, "geoloc_replay: the page stays at %s; Ctrl-C ends it\n",
                 program.page->url().c_str());
  while (!stop.is_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds{50});
    program.show->play_again(stop);
    if (keep_notes(program.options.recording, program.outputs))
      has_failed = !write_noted_objects(program.options.outputs, program.config,
                                        program.recording.class_names, program.outputs, record);
  }
  return has_failed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli("Replays a recording of geoloc_app or geoloc_sim and writes the objects found.",
               "geoloc_replay");
  Options options;
  add_options(cli, options);
  if (const auto status = parse(cli, argc, argv)) return *status;

  std::unique_ptr<Program> program;
  const auto unusable = guard("geoloc_replay", kUnusable, [&] { program = make_program(options); });
  if (unusable) return *unusable;
  if (!program) return kDone;

  const StopSignal stop;
  tell_skipped(program->recording.skipped);
  if (program->page)
    std::fprintf(stderr, "%s\n",
                 page_message(*program->page, options.outputs, isatty(STDERR_FILENO) == 1).c_str());
  program->show->play_to_end(stop);
  keep_notes(options.recording, program->outputs);
  for (const std::string& line : program->show->session().take_news())
    std::fprintf(stderr, "geoloc_replay: %s\n", line.c_str());

  io::RunRecord record =
      record_run(program->show->session(), program->recording.class_names, program->truth, options.recording);
  add_summary(options.outputs, program->show->session(), record);
  program->outputs.finish(record);
  program->show->show_end();
  program->tell_all();
  if (options.outputs.wants_table()) std::fputs(objects_to_table(record.objects).c_str(), stdout);
  std::fprintf(stderr, "%s\n", record.summary.c_str());
  if (program->delivery) std::fprintf(stderr, "%s\n", program->delivery->words().c_str());
  const bool has_failed = keep_page(*program, record, stop);
  return has_failed || program->outputs.has_failed() ? kFailed : kDone;
}
