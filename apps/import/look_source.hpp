// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "common/detector_options.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/io/stills/labels.hpp"

namespace geoloc::apps {

/// What tells an import what is to be seen: labels that were made before, or else a detector, which has no
/// configuration but the command line.
struct LookSource {
  std::optional<io::Labels> labels;
  io::DetectionConfig config;              ///< of the detector, with what its model decides
  std::unique_ptr<io::Detector> detector;  ///< nullptr where there are labels
};

/// nullopt for an empty name. Throws std::runtime_error naming file, line and reason.
std::optional<io::Labels> labels_in(const std::string& labels_file);

/// Opens it where there are no labels, and tells of what the model decides. Throws as io::open_detector().
void open_detector_unless_labelled(const DetectorOptions& options, const DetectorTuning& tuning,
                                   LookSource& source);

/// The classes' names and, so that a replay scores itself, the labels' marks as true targets. Heights only
/// count where they have the datum of the pictures.
void write_classes_and_truth(const LookSource& source, io::RecordingWriter& writer);

/// The last lines of an import: why there may be nothing in it, and what comes next.
void tell_next_step(const LookSource& source, std::size_t detections, const std::string& recording);

}  // namespace geoloc::apps
