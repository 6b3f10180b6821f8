// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/output_files.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"

namespace geoloc::apps {

/// Which network, and what runs it; empty where the command line does not say.
struct DetectorOptions {
  std::string model_file;
  std::string class_names_file;
  std::string second_look_file;  ///< "none": without
  std::string backend;
};

/// --model, --class-names, --second-look, --backend.
void add_detector_options(CLI::App& program, DetectorOptions& options);

/// How that network is used; empty where the command line does not say.
struct DetectorTuning {
  std::optional<double> confidence;
  std::vector<int> tiles;          ///< columns, rows
  std::vector<int> input_size_px;  ///< width, height
  std::string layout;
};

/// --confidence, --tiles, --input-size, --layout.
void add_detector_tuning(CLI::App& program, DetectorTuning& tuning);

/// What the command line says over what the configuration says. Throws std::invalid_argument naming every
/// problem.
io::DetectionConfig detection_of(const DetectorOptions& options, const DetectorTuning& tuning,
                                 const io::DetectionConfig& configured);

/// The model named, or the one that comes with geoloc. Throws std::runtime_error where that is not found.
io::DetectorFiles detector_files(const DetectorOptions& options);

/// Those files that the command line names, as inputs for check_outputs().
NamedFiles files_of(const DetectorOptions& options);

/// On a confidence that the model decided; empty where the user did, or named no model.
std::string confidence_note(const DetectorOptions& options, double configured, double in_force);

/// Why a detector that found nothing did so, for people.
std::string nothing_detected(const io::DetectorCounts& counts, double confidence);

/// --backend over what the configuration says.
io::DetectionConfig with_backend(const DetectorOptions& options, io::DetectionConfig config);

}  // namespace geoloc::apps
