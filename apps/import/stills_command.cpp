// SPDX-License-Identifier: Apache-2.0
#include "import/stills_command.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/command_line.hpp"
#include "common/stop_signal.hpp"
#include "detect/inputs.hpp"
#include "geoloc/io/json/camera_file.hpp"
#include "import/flight_plan.hpp"
#include "import/import_words.hpp"
#include "import/look_source.hpp"
#include "import/picture_looks.hpp"
#include "import/picture_reader.hpp"
#include "import/recording_maker.hpp"

namespace geoloc::apps {
namespace {

/// Each once, though a folder and its pictures may both be named.
std::vector<std::filesystem::path> files_of(const std::vector<DetectInput>& inputs) {
  std::vector<std::filesystem::path> files;
  for (const DetectInput& input : inputs) files.push_back(std::filesystem::weakly_canonical(input.file));
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

std::optional<double> mean_height_m(const std::vector<io::SurveyedMark>& marks) {
  if (marks.empty()) return std::nullopt;
  const double sum_m = std::accumulate(marks.begin(), marks.end(), 0.0,
                                       [](double sum, const auto& mark) { return sum + mark.height_m; });
  return sum_m / static_cast<double>(marks.size());
}

FlightFacts facts_of(const StillsOptions& options, const std::optional<io::Labels>& labels) {
  FlightFacts facts;
  facts.utc_offset_h = options.utc_offset_h;
  facts.take_off_height_m = options.take_off_height_m;
  facts.camera_pitch_deg = options.gimbal_pitch_deg;
  if (labels) facts.marks_height_m = mean_height_m(labels->marks);
  if (!options.camera_file.empty())
    facts.lens =
        io::Lens{io::read_camera_file(options.camera_file).intrinsics, io::FocalSource::kCalibration};
  return facts;
}

/// Everything that can be wrong before the first picture is read is found while this is made.
struct StillsProgram {
  explicit StillsProgram(const StillsOptions& given)
      : options(given), inputs(files_of(find_inputs(given.inputs))) {
    source.labels = labels_in(options.labels_file);
    facts = facts_of(options, source.labels);
    open_detector_unless_labelled(options.detector, options.tuning, source);
    recording = std::make_unique<RecordingMaker>(options.out);
  }

  StillsOptions options;
  std::vector<std::filesystem::path> inputs;
  LookSource source;
  FlightFacts facts;
  std::unique_ptr<RecordingMaker> recording;
};

FlightPlan plan_of(const StillsProgram& program, const StopSignal& stop) {
  ReadStills read = read_stills(program.inputs, stop);
  tell_left_out(read.left_out);
  FlightPlan plan = plan_flight(std::move(read.stills), program.facts);
  tell_left_out(plan.left_out);
  tell_plan(plan.notes, plan.assumptions);
  if (plan.exposures.empty() && !stop.is_requested())
    throw std::runtime_error("no picture can be used, so that nothing was written");
  return plan;
}

PictureLooks looks_of(const StillsProgram& program, const FlightPlan& plan, const StopSignal& stop) {
  if (stop.is_requested()) return {};
  const LookSource& source = program.source;
  PictureLooks looks = source.labels
                           ? labelled_looks(plan.exposures, *source.labels, program.options.labels_file)
                           : detected_looks(plan.exposures, *source.detector, stop);
  tell_left_out(looks.left_out);
  const bool is_blind = std::none_of(looks.by_exposure.begin(), looks.by_exposure.end(),
                                     [](const auto& look) { return look.has_value(); });
  if (is_blind && !stop.is_requested())
    throw std::runtime_error("no picture could be looked at, so that nothing was written");
  return looks;
}

void write(StillsProgram& program, const FlightPlan& plan, const PictureLooks& looks) {
  program.recording->write(plan, looks);
  write_classes_and_truth(program.source, program.recording->writer());
  program.recording->finish();
}

void tell_end(const StillsProgram& program, const PictureLooks& looks) {
  std::size_t frames = 0, detections = 0;
  for (const auto& look : looks.by_exposure) {
    frames += look ? 1 : 0;
    detections += look ? look->size() : 0;
  }
  tell(std::to_string(frames) + " pictures with " + std::to_string(detections) + " detections in " +
       program.options.out);
  tell_next_step(program.source, detections, program.options.out);
}

}  // namespace

int import_stills(const StillsOptions& options) {
  std::unique_ptr<StillsProgram> program;
  const StopSignal stop;
  FlightPlan plan;
  const auto unusable = guard("geoloc_import", kUnusable, [&] {
    program = std::make_unique<StillsProgram>(options);
    plan = plan_of(*program, stop);
  });
  if (unusable) return *unusable;
  PictureLooks looks;
  const auto unlabelled = guard("geoloc_import", kUnusable, [&] { looks = looks_of(*program, plan, stop); });
  if (unlabelled) return *unlabelled;
  if (stop.is_requested()) {
    tell("stopped: nothing was written");
    return kFailed;
  }
  const auto failed = guard("geoloc_import", kFailed, [&] { write(*program, plan, looks); });
  if (failed) return *failed;
  tell_end(*program, looks);
  return kDone;
}

}  // namespace geoloc::apps
