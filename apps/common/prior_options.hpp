// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/output_files.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"

namespace geoloc::apps {

/// What is known before a flight.
struct PriorFiles {
  std::string known_points;  ///< GeoJSON of surveyed objects
  std::string calibration;   ///< what an earlier flight learnt of the camera
};

/// --known-points, --calibration.
void add_prior_options(CLI::App& program, PriorFiles& files);

/// Those given, as inputs for check_outputs().
NamedFiles files_of(const PriorFiles& files);

/// Reads them over `config`. Throws std::runtime_error naming the file and the reason.
void apply_priors(const PriorFiles& files, GeolocatorConfig& config);

}  // namespace geoloc::apps
