// SPDX-License-Identifier: Apache-2.0
#include "import/video_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/command_line.hpp"
#include "common/stop_signal.hpp"
#include "common/video_vehicle.hpp"
#include "geoloc/io/json/camera_file.hpp"
#include "import/import_words.hpp"
#include "import/log_source.hpp"
#include "import/look_source.hpp"
#include "import/recording_maker.hpp"
#include "import/told_video.hpp"
#include "import/video_camera.hpp"
#include "import/video_looks.hpp"
#include "import/video_offset.hpp"
#include "import/video_recording.hpp"

namespace geoloc::apps {
namespace {

TrackFacts facts_of(const VideoOptions& options) {
  return {options.utc_offset_h, options.take_off_height_m, options.gimbal_pitch_deg};
}

std::optional<Duration> told_offset(const VideoOptions& options) {
  if (options.log_offset == "auto") return std::nullopt;
  return from_seconds(std::stod(options.log_offset));
}

/// Whose work the found file holds.
std::string work_of(const VideoOptions& options, const io::DetectionConfig& config) {
  const std::filesystem::path video = std::filesystem::canonical(options.video);
  std::string work = fmt::format(
      "geoloc_import: {} of {} bytes, by {} and {}", video.string(), std::filesystem::file_size(video),
      detector_files(options.detector).model.string(), options.detector.second_look_file);
  work += fmt::format(", confidence {}, layout {}", config.confidence, options.tuning.layout);
  for (const auto* list : {&options.tuning.tiles, &options.tuning.input_size_px}) {
    for (const int number : *list) work += fmt::format(", {}", number);
  }
  return work;
}

/// A mount of kind gimbal without angles would locate nothing.
void refuse_gimbal_without_angles(const CameraConfig& camera, const LogSource& log,
                                  const VideoOptions& options) {
  if (camera.mount.kind != MountKind::kGimbal || !log.track) return;
  if (log.has_gimbal() || !log.track->assumed_gimbal.empty()) return;
  throw std::runtime_error(fmt::format(
      "{}: the mount is of kind gimbal, and {} has no angles of one: give --gimbal-pitch-deg, the "
      "pitch that it held, or the mount of a camera that is fixed",
      options.camera_file, options.log));
}

/// Where a log has the angles of a gimbal, the camera is taken to be on it.
void note_gimbal(const CameraConfig& camera, const LogSource& log, std::vector<std::string>& assumptions) {
  if (camera.mount.kind == MountKind::kGimbal || !log.has_gimbal()) return;
  assumptions.emplace_back(
      "the log has the angles of a gimbal: the camera is taken to be on it, whatever angles the mount of "
      "--camera has "
      "(\"kind\": \"gimbal\" there says that they are the camera's in the gimbal)");
}

/// Everything that can be wrong before the first frame is looked at is found while this is made.
struct VideoProgram {
  VideoProgram(const VideoOptions& given, const StopSignal& stop)
      : options(given), facts(video_facts(options.video)) {
    if (options.log.empty())
      take_log(read_told_video(options.video, stop));
    else
      take_log(read_log(options.log, facts_of(options)));
    if (stop.is_requested()) return;
    refuse_gimbal_without_angles(camera.config, log, options);
    if (!told) note_gimbal(camera.config, log, assumptions);
    source.labels = labels_in(options.labels_file);
    open_detector_unless_labelled(options.detector, options.tuning, source);
    const std::string work = source.detector ? work_of(options, source.config) : std::string{};
    recording = std::make_unique<RecordingMaker>(options.out);
    if (source.detector) found = std::make_unique<FoundFile>(options.out + ".found.jsonl", work);
  }

  void take_log(LogSource beside) {
    log = std::move(beside);
    camera = video_camera(options.camera_file, facts, {log.focal_lengths, std::nullopt, false}, assumptions);
    offset = find_offset({facts.file.created_at, facts.file.duration}, log.times, told_offset(options));
  }

  void take_log(ToldVideo video) {
    told = std::move(video);
    log = std::move(told->log);
    offset = told->offset;
    camera = video_camera(options.camera_file, facts, {{}, told->horizontal_fov_deg, told->has_gimbal},
                          assumptions);
  }

  VideoOptions options;
  std::vector<std::string> assumptions;
  VideoFacts facts;
  LogSource log;
  std::optional<ToldVideo> told;  ///< where the video is its own log, which is in `log`
  VideoCamera camera;
  VideoOffset offset;
  LookSource source;
  std::unique_ptr<RecordingMaker> recording;
  std::unique_ptr<FoundFile> found;  ///< of the detector
};

void tell_begin(const VideoProgram& program) {
  if (program.log.track) tell_plan(program.log.track->notes, program.log.track->assumptions);
  if (program.told) tell_plan(program.told->notes, program.told->assumptions);
  tell_plan({}, program.assumptions);
  tell(fmt::format(
      "the video begins {:.2f} s after the log's beginning, {}, to {:g} s (1 sigma): what is left "
      "is found with the objects, as a latency{}",
      seconds(program.offset.after_log_begin), program.offset.how, program.offset.sigma_s,
      program.options.log_offset == "auto" && !program.told ? " (--log-offset-s says another)" : ""));
}

std::vector<VideoLook> looks_of(VideoProgram& program, const StopSignal& stop) {
  std::vector<std::string> notes;
  const VideoOptions& options = program.options;
  std::vector<VideoLook> looks =
      program.source.labels
          ? labelled_looks(options.video, *program.source.labels, options.labels_file, stop, notes)
          : detected_looks(options.video, *program.source.detector, *program.found, stop, notes);
  for (const std::string& note : notes) tell(note);
  if (looks.empty() && !stop.is_requested())
    throw std::runtime_error("no frame could be looked at, so that nothing was written");
  return looks;
}

void write(VideoProgram& program, std::vector<VideoLook>& looks) {
  io::RecordingWriter& writer = program.recording->writer();
  VideoFlight flight{program.log, program.camera, program.offset, looks};
  if (program.told) {
    const std::size_t untold = take_told_times(*program.told, looks);
    if (untold > 0) tell(fmt::format("{} frames are left out: they carry no time of their own", untold));
    flight.time_quality = io::TimeQuality::kTelemetry;
    flight.time_sigma_s = kToldTimeSigma_s;
  }
  const std::size_t left_out = write_video_flight(flight, writer);
  if (left_out > 0)
    tell(fmt::format("{} frames are left out: how the camera looked then is not known", left_out));
  write_classes_and_truth(program.source, writer);
  program.recording->finish();
  if (program.found) program.found->remove();
}

void tell_end(const VideoProgram& program, const std::vector<VideoLook>& looks) {
  std::size_t detections = 0;
  for (const VideoLook& look : looks) detections += look.detections.size();
  tell(fmt::format("{} frames with {} detections in {}", looks.size(), detections, program.options.out));
  tell_next_step(program.source, detections, program.options.out);
}

int tell_stopped(const VideoProgram& program) {
  tell(program.found ? "stopped: what was found so far is kept in " + program.found->name().string() +
                           ", and the same command goes on from there"
                     : std::string("stopped: nothing was written"));
  return kFailed;
}

}  // namespace

int import_video(const VideoOptions& options) {
  std::unique_ptr<VideoProgram> program;
  const StopSignal stop;
  std::vector<VideoLook> looks;
  const auto unusable = guard("geoloc_import", kUnusable, [&] {
    program = std::make_unique<VideoProgram>(options, stop);
    if (!stop.is_requested()) tell_begin(*program);
  });
  if (unusable) return *unusable;
  if (stop.is_requested()) return tell_stopped(*program);
  const auto unseen = guard("geoloc_import", kUnusable, [&] { looks = looks_of(*program, stop); });
  if (unseen) return *unseen;
  if (stop.is_requested()) return tell_stopped(*program);
  const auto failed = guard("geoloc_import", kFailed, [&] { write(*program, looks); });
  if (failed) return *failed;
  tell_end(*program, looks);
  return kDone;
}

}  // namespace geoloc::apps
