// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/stop_signal.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/stills/labels.hpp"
#include "import/flight_plan.hpp"

namespace geoloc::apps {

/// What was seen in the pictures of a plan.
struct PictureLooks {
  /// One an exposure; nullopt: nobody looked, which is not the same as that nothing was seen.
  std::vector<std::optional<std::vector<Detection>>> by_exposure;
  std::vector<std::string> left_out;  ///< file and reason
};

/// What people labelled. Throws std::runtime_error where no label belongs to these pictures; pictures that
/// are not there are named in `left_out`.
PictureLooks labelled_looks(const std::vector<Exposure>& exposures, const io::Labels& labels,
                            const std::string& labels_file);

/// What a detector finds, with progress, until `stop`.
PictureLooks detected_looks(const std::vector<Exposure>& exposures, io::Detector& detector,
                            const StopSignal& stop);

}  // namespace geoloc::apps
