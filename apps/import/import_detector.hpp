// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "common/detector_options.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "import/import_words.hpp"

namespace geoloc::apps {

/// The detector of an import, which has no configuration but its command line.
struct ImportDetector {
  io::DetectionConfig config;              ///< with what the model decides
  std::unique_ptr<io::Detector> detector;  ///< nullptr where there are labels
};

/// Tells of what the model decides. Throws as io::open_detector().
inline ImportDetector open_import_detector(const DetectorOptions& options, const DetectorTuning& tuning) {
  const io::DetectorFiles files = detector_files(options);
  const io::DetectionConfig wanted = detection_of(options, tuning, {});
  const io::DetectionConfig config = io::with_model_defaults(files, wanted);
  auto detector = io::open_detector(files, config);
  const std::string note = confidence_note(options, wanted.confidence, config.confidence);
  if (!note.empty()) tell(note);
  return {config, std::move(detector)};
}

}  // namespace geoloc::apps
