// SPDX-License-Identifier: Apache-2.0
#include "common/detector_options.hpp"

#include <fmt/format.h>

#include "common/data_files.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "io/detection/detection_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::apps {
namespace {

CLI::IsMember layout_names() {
  std::vector<std::string> names;
  for (const auto& [layout, name] : EnumNames<io::OutputLayout>::all) names.emplace_back(name);
  return CLI::IsMember(names);
}

io::OutputLayout layout_named(const std::string& wanted) {
  for (const auto& [layout, name] : EnumNames<io::OutputLayout>::all) {
    if (wanted == name) return layout;
  }
  return io::OutputLayout::kAuto;
}

}  // namespace

void add_detector_options(CLI::App& program, DetectorOptions& options) {
  program
      .add_option("--model", options.model_file,
                  "Detector, ONNX in a layout of docs/detection.md; default: the fiducial target's")
      ->type_name("FILE");
  program
      .add_option("--class-names", options.class_names_file,
                  "A class name a line; default: those in the model")
      ->type_name("FILE");
  program
      .add_option(
          "--second-look", options.second_look_file,
          "Network that looks again at each box of the detector, ONNX, or none; default: the one that "
          "the model names")
      ->type_name("FILE");
  program
      .add_option("--backend", options.backend, "What runs the model; default: opencv, or detection.backend")
      ->type_name("NAME")
      ->check(CLI::IsMember({"opencv", "openvino"}));
}

void add_detector_tuning(CLI::App& program, DetectorTuning& tuning) {
  program.add_option("--confidence", tuning.confidence,
                     "Leave out boxes with a lower score; default: detection.confidence, or the model's own");
  program
      .add_option("--tiles", tuning.tiles,
                  "Look at so many by so many tiles of each picture as well; default: detection.tile_columns "
                  "and tile_rows")
      ->type_name("COLUMNS ROWS")
      ->expected(2);
  program
      .add_option("--input-size", tuning.input_size_px,
                  "Of the network's input, px, for models that leave it open; default: the model's own")
      ->type_name("WIDTH HEIGHT")
      ->expected(2);
  program
      .add_option("--layout", tuning.layout,
                  "How the network's output lists its boxes: " + list_names<io::OutputLayout>() +
                      "; default: detection.layout")
      ->type_name("NAME")
      ->check(layout_names());
}

io::DetectionConfig detection_of(const DetectorOptions& options, const DetectorTuning& tuning,
                                 const io::DetectionConfig& configured) {
  io::DetectionConfig config = with_backend(options, configured);
  if (tuning.confidence) config.confidence = *tuning.confidence;
  if (!tuning.tiles.empty()) {
    config.tile_columns = tuning.tiles[0];
    config.tile_rows = tuning.tiles[1];
  }
  if (!tuning.input_size_px.empty()) {
    config.input_width_px = tuning.input_size_px[0];
    config.input_height_px = tuning.input_size_px[1];
  }
  if (!tuning.layout.empty()) config.layout = layout_named(tuning.layout);
  refuse_if_any(check_fields(config, "detection"));
  return config;
}

io::DetectorFiles detector_files(const DetectorOptions& options) {
  io::DetectorFiles files;
  files.model = options.model_file.empty() ? find_data("models/fiducial.onnx")
                                           : std::filesystem::path(options.model_file);
  if (!options.class_names_file.empty()) files.class_names = options.class_names_file;
  if (!options.second_look_file.empty())
    files.second_look = options.second_look_file == "none" ? "" : options.second_look_file;
  return files;
}

NamedFiles files_of(const DetectorOptions& options) {
  NamedFiles files;
  add_named(files, "--model", options.model_file);
  add_named(files, "--class-names", options.class_names_file);
  if (options.second_look_file != "none") add_named(files, "--second-look", options.second_look_file);
  return files;
}

std::string confidence_note(const DetectorOptions& options, double configured, double in_force) {
  if (options.model_file.empty() || configured > 0.0) return {};
  return fmt::format(
      "{}: boxes of score {:g} and up count, as is usual for such a model (detection.confidence)",
      options.model_file, in_force);
}

std::string nothing_detected(const io::DetectorCounts& counts, double confidence) {
  return fmt::format("nothing reached detection.confidence ({:g}): the best score below it was {:.2f}",
                     confidence, counts.best_score_below);
}

io::DetectionConfig with_backend(const DetectorOptions& options, io::DetectionConfig config) {
  if (options.backend == "opencv") config.backend = io::Backend::kOpencv;
  if (options.backend == "openvino") config.backend = io::Backend::kOpenvino;
  return config;
}

}  // namespace geoloc::apps
