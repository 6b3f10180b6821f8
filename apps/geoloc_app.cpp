// SPDX-License-Identifier: Apache-2.0
// Live: telemetry by MAVLink and a camera's frames in, geographic coordinates of objects out.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/closing_words.hpp"
#include "app/console.hpp"
#include "app/damage_watch.hpp"
#include "app/detector_timing.hpp"
#include "app/live_inputs.hpp"
#include "app/live_options.hpp"
#include "app/live_run.hpp"
#include "app/live_status.hpp"
#include "app/object_pictures.hpp"
#include "app/page_pictures.hpp"
#include "app/recorder.hpp"
#include "app/resources.hpp"
#include "app/steady_text.hpp"
#include "app/telemetry_input.hpp"
#include "app/vehicle_reports.hpp"
#include "app/video_tally.hpp"
#include "common/command_line.hpp"
#include "common/diagnosis.hpp"
#include "common/last_words.hpp"
#include "common/link_message.hpp"
#include "common/live_page_output.hpp"
#include "common/message_box.hpp"
#include "common/objects_table.hpp"
#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "common/periodic.hpp"
#include "common/run_record.hpp"
#include "common/stop_signal.hpp"
#include "common/text_writer.hpp"
#include "geoloc/io/video/library_messages.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

constexpr auto kStatusPeriod = std::chrono::seconds{1};
/// Files are written anew so often, so that a power cut costs seconds.
constexpr auto kFilePeriod = std::chrono::seconds{5};
/// Streams come and go within minutes at most.
constexpr auto kMemoryPeriod = std::chrono::minutes{1};
constexpr auto kDoubtsBegin = std::chrono::seconds{15};
constexpr auto kDoubtLasts = std::chrono::seconds{30};
constexpr auto kTablePatience = std::chrono::seconds{5};

/// Everything that can be wrong with arguments, files, model and port is found while this is made.
struct Program {
  explicit Program(const LiveOptions& given)
      : options(given),
        inputs(open_inputs(given, clock)),
        reports(inputs.config.estimation, inputs.detector->class_names()),
        session(inputs.config.estimation,
                [this](HostTime received_at, const std::uint8_t* frame, std::size_t size) {
                  recorder->add_telemetry(received_at, frame, size);
                  reports.on_telemetry(frame, size);
                }),
        telemetry(telemetry_settings(), inputs.socket.get(), *inputs.guard, *inputs.video, clock),
        outputs(inputs.detector->class_names(), {}) {
    add_sinks(given.outputs, inputs.config.estimation, io::OldFile::kKeep, outputs, inputs.passed_on);
    delivery = add_summary_publisher(given.outputs, inputs.config.estimation, outputs);
    if (!given.outputs.wants_raw_fixes()) session.history().only_count_fixes();
    page = open_live_page(given.outputs, given.ground, inputs.config.estimation.live_page, {source(), true},
                          inputs.detector->class_names(), outputs);
    if (page) outputs.add(std::make_unique<io::LivePageSink>(page));
    recorder.emplace(given.record_folder, [this](io::RecordingWriter& writer) { write_settings(writer); });
  }

  TelemetryInput::Settings telemetry_settings() const {
    const auto system = static_cast<std::uint8_t>(inputs.config.estimation.mavlink.system_id);
    const MountKind mount = inputs.config.estimation.geolocator.camera.mount.kind;
    return {options.is_udp_given, std::max<std::uint8_t>(1, system), mount == MountKind::kGimbal};
  }

  void write_settings(io::RecordingWriter& writer) const {
    writer.write_camera(inputs.config.estimation.geolocator.camera);
    writer.write_config(live_to_json(inputs.config).dump(2));
    writer.write_class_names(inputs.detector->class_names());
    if (!inputs.truth.empty()) writer.write_truth(inputs.truth);
  }

  /// For people; the stream's address may hold a password.
  std::string source() const { return options.rtsp_url.empty() ? options.video_file : "live run"; }

  io::RunRecord record() const {
    io::RunRecord run =
        record_run(session, inputs.detector->class_names(), inputs.truth, "geoloc: " + source());
    add_summary(options.outputs, session, run);
    return run;
  }

  LiveOptions options;
  io::HostClock clock;
  LiveInputs inputs;
  VehicleReports reports;
  Session session;
  TelemetryInput telemetry;
  Outputs outputs;
  std::shared_ptr<io::LivePage> page;                   ///< nullptr where none is wanted
  std::shared_ptr<const io::SummaryDelivery> delivery;  ///< to the fleet; nullptr where there is none
  std::optional<Recorder> recorder;  ///< made last: a run that cannot begin leaves no folder
};

std::string telemetry_words(const LiveOptions& options) {
  return (options.is_udp_given ? "listening for MAVLink on UDP "
                               : "telemetry is the video's own where it carries any, else MAVLink on UDP ") +
         options.udp;
}

void record_notes(Program& program) {
  for (io::NotedObject& noted : program.outputs.notes()->take_added())
    program.recorder->add_note(std::move(noted));
}

void tell_all(const std::vector<std::string>& messages, Console& console) {
  for (const std::string& message : messages) console.say("geoloc_app: " + message);
}

/// What seems wrong with the input of the run so far: the first that is, or empty. The beginning tells
/// little.
std::string doubt_of(const Session& session, const VideoTally& tally, Duration elapsed) {
  if (elapsed < kDoubtsBegin) return {};
  const std::string slow = slowness(tally);
  if (!slow.empty() || session.frames() == 0) return slow;
  const std::vector<std::string> sentences = diagnose(facts_of(session));
  return sentences.empty() ? "" : sentences.front();
}

/// Until the video ends or the user has enough.
VideoEnd run_until_stopped(Program& program, MessageBox& library_words, Console& console,
                           const StopSignal& stop) {
  const LiveInputs& inputs = program.inputs;
  std::optional<PagePictures> pictures;
  if (program.page) pictures.emplace(program.page, inputs.config.estimation.live_page.picture_width_px);
  ObjectPictures object_pictures(
      [&program](std::uint64_t id, const std::string& jpeg) {
        if (program.page) program.page->show_object(id, jpeg);
        program.recorder->add_picture(id, jpeg);
      },
      [&program](std::uint64_t id) {
        if (program.page) program.page->forget_picture(id);
        program.recorder->remove_picture(id);
      });
  const bool keeps_pictures = program.page || !program.options.record_folder.empty();
  const auto on_detected = [&](const io::VideoFrame& frame, const std::vector<Detection>& detections) {
    if (pictures) pictures->offer(frame, detections);
    if (keeps_pictures) object_pictures.offer(frame, detections);
  };
  DetectionWorker worker(*inputs.video, *inputs.detector,
                         inputs.config.estimation.geolocator.camera.intrinsics, program.clock, on_detected);
  LiveRun run(program.session, program.telemetry, worker, *program.recorder, program.reports, program.clock,
              [&](const PendingFrame& frame, bool is_located) {
                if (is_located) object_pictures.assign(program.session.geolocator(), frame.captured_at);
                program.outputs.post_frame(program.session, frame, is_located);
              });
  const HostTime started_at = program.clock.now();
  DamageWatch damage(inputs.config.video.transport);
  SteadyText doubt(kDoubtLasts);
  Periodic status(kStatusPeriod, {}), files(kFilePeriod, started_at), memory(kMemoryPeriod, started_at);
  while (!stop.is_requested() && !run.has_ended()) {
    run.step();
    const HostTime now = program.clock.now();
    if (status.is_due(now)) {
      record_notes(program);
      const io::VideoStatus video = inputs.video->status();
      const std::string doubt_now =
          doubt_of(program.session, tally_of(video, worker.stats()), now - started_at);
      auto state = live_status(now, started_at, program.session, program.telemetry, *inputs.video, worker,
                               run, damage.observe(now, video), doubt.show(now, doubt_now));
      if (program.delivery) state.fleet = program.delivery->words();
      tell_all(library_words.take(), console);
      tell_all(program.outputs.take_messages(), console);
      tell_all(program.recorder->take_messages(), console);
      tell_all(program.session.take_news(), console);
      tell_all(program.telemetry.take_messages(), console);
      console.update(state);
      program.outputs.post_status(state);
      if (inputs.signing_store) inputs.signing_store->keep(*inputs.guard->signing_stamps());
    }
    if (memory.is_due(now)) give_back_memory();
    if (!files.is_due(now)) continue;
    program.session.note_damaged(worker.stats().damaged);
    program.outputs.post_run(program.record());
  }
  const DetectionWorker::Stats detection = worker.stats();
  program.session.note_damaged(detection.damaged);
  if (inputs.signing_store) inputs.signing_store->keep(*inputs.guard->signing_stamps());
  return {tally_of(inputs.video->status(), detection), detection, run.stats()};
}

/// False where stdout does not take it.
bool show_table(const io::RunRecord& record, Console& console) {
  TextWriter table(STDOUT_FILENO);
  table.post(objects_to_table(record.objects));
  const bool is_shown = table.finish(kTablePatience);
  if (!is_shown) console.say("geoloc_app: stdout does not take the table of objects; name a file with --out");
  return is_shown;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory_compact();
  leave_last_words("geoloc_app");
  take_write_signals_as_errors();
  CLI::App cli("Finds ground objects in a drone's live video and gives their coordinates.", "geoloc_app");
  LiveOptions options;
  add_live_options(cli, options);
  if (const auto status = parse(cli, argc, argv)) return *status;

  const auto library_words = std::make_shared<MessageBox>();
  io::take_library_messages([library_words](const std::string& message, bool is_fatal) {
    if (is_fatal) end_with_last_words(message.c_str());
    library_words->post(message);
  });
  std::unique_ptr<Program> program;
  const auto unusable = guard("geoloc_app", kUnusable, [&] {
    if (options.print_settings) {
      std::fputs(live_settings_table().c_str(), stdout);
    } else if (options.print_config) {
      std::puts(live_to_json(config_to_print(options)).dump(2).c_str());
    } else if (options.time_detector) {
      std::puts(time_detector(options).c_str());
    } else {
      require_resources();
      program = std::make_unique<Program>(options);
    }
  });
  Console console;
  tell_all(library_words->take(), console);
  if (unusable) return *unusable;
  if (!program) return kDone;

  const StopSignal stop;
  console.say(telemetry_words(options) + "; Ctrl-C ends the run and writes its results");
  if (!program->inputs.remarks.empty()) console.say(program->inputs.remarks);
  if (program->inputs.signing_store && !program->inputs.signing_store->remark().empty())
    console.say(program->inputs.signing_store->remark());
  if (program->page) console.say(page_message(*program->page, options.outputs, isatty(STDERR_FILENO) == 1));
  const VideoEnd video = run_until_stopped(*program, *library_words, console, stop);
  program->session.finish();

  record_notes(*program);
  program->recorder->finish([damaged = program->session.frames_damaged()](io::RecordingWriter& writer) {
    writer.write_damaged(damaged);
  });
  tell_all(program->recorder->take_messages(), console);
  const io::RunRecord record = program->record();
  program->outputs.finish(record);
  tell_all(program->outputs.take_messages(), console);
  tell_all(library_words->take(), console);
  if (program->delivery) console.say(program->delivery->words());
  const std::string refusals = count_of_refusals(program->inputs.guard->counts());
  if (!refusals.empty()) console.say(refusals);
  console.say(record.summary);
  const LiveInputs& inputs = program->inputs;
  for (const std::string& line :
       closing_words(video, inputs.detector->counts(), inputs.config.detection.confidence))
    console.say(line);
  const bool is_shown = !options.outputs.wants_table() || show_table(record, console);
  const bool has_failed = program->outputs.has_failed() || program->recorder->has_failed() || !is_shown;
  return has_failed ? kFailed : kDone;
}
