// SPDX-License-Identifier: Apache-2.0
// Runs the detector over pictures and videos: whether a model works on a camera's footage, before any flight.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/live_config.hpp"
#include "common/command_line.hpp"
#include "common/detector_options.hpp"
#include "common/ignored_settings.hpp"
#include "detect/detect_run.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

struct Options {
  std::vector<std::string> inputs;
  DetectorOptions detector;
  std::string config_file;
  DetectorTuning tuning;
  ResultWriter::Places places;
};

void add_options(CLI::App& program, Options& options) {
  program.add_option("INPUT", options.inputs, "Pictures, videos, or folders of pictures")->required();
  add_detector_options(program, options.detector);
  program.add_option("--config", options.config_file, "Settings, JSON: \"detection\" of those of geoloc_app")
      ->type_name("FILE");
  add_detector_tuning(program, options.tuning);
  program.add_option("--json", options.places.json, "Write a line of JSON for each picture; - is stdout")
      ->type_name("FILE");
  program.add_option("--draw", options.places.draw, "Write each picture and video with its boxes here")
      ->type_name("DIR");
}

void tell_ignored(const nlohmann::json& document, const std::string& name) {
  std::vector<Ignored> ignored;
  for (const auto& [section, settings] : document.items()) {
    if (section != "detection" && section != "video")
      ignored.push_back({section, "only detection and video are used"});
  }
  const LiveConfig defaults;
  for (const std::string& line : ignored_settings(document, live_to_json(defaults), ignored, name))
    std::fprintf(stderr, "geoloc_detect: %s\n", line.c_str());
}

/// Everything that can be wrong before the first picture is found while this is made.
struct Program {
  explicit Program(const Options& options) : inputs(find_inputs(options.inputs)) {
    if (!options.config_file.empty()) {
      std::vector<std::string> problems;
      const nlohmann::json document = read_config_document(options.config_file);
      live_from_json(document, config, problems);
      refuse_problems(options.config_file, problems);
      tell_ignored(document, options.config_file);
    }
    const io::DetectorFiles files = detector_files(options.detector);
    const io::DetectionConfig wanted = detection_of(options.detector, options.tuning, config.detection);
    config.detection = io::with_model_defaults(files, wanted);
    detector = io::open_detector(files, config.detection);
    note = confidence_note(options.detector, wanted.confidence, config.detection.confidence);
    results = std::make_unique<ResultWriter>(
        options.places, inputs, joined({files_of_config(options.config_file), files_of(options.detector)}),
        detector->class_names());
  }

  std::vector<DetectInput> inputs;
  LiveConfig config;
  std::string note;  ///< for the user; may be empty
  std::unique_ptr<io::Detector> detector;
  std::unique_ptr<ResultWriter> results;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli("Finds objects in pictures and videos with a detector's model.", "geoloc_detect");
  Options options;
  add_options(cli, options);
  if (const auto status = parse(cli, argc, argv)) return *status;

  std::unique_ptr<Program> program;
  const auto unusable =
      guard("geoloc_detect", kUnusable, [&] { program = std::make_unique<Program>(options); });
  if (unusable) return *unusable;

  if (!program->note.empty()) std::fprintf(stderr, "geoloc_detect: %s\n", program->note.c_str());
  DetectRun run(*program->detector, *program->results, program->config.video, program->inputs.size(),
                program->config.detection.confidence);
  const auto failed = guard("geoloc_detect", kFailed, [&] {
    for (const DetectInput& input : program->inputs) {
      if (!run.is_stopped()) run.look_at(input);
    }
    run.finish();
    if (run.counts().pictures > 0) program->results->finish();
  });
  if (run.counts().pictures > 0) std::fprintf(stderr, "%s\n", run.summary().c_str());
  if (failed) return *failed;
  if (run.counts().unreadable > 0) return kUnusable;
  return program->detector->counts().failed_images > 0 ? kFailed : kDone;
}
