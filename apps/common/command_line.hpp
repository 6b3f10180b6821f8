// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "common/sinks.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"

namespace geoloc::apps {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kUnusable = 2;  ///< arguments or input

/// What is known before a flight.
struct PriorFiles {
  std::string known_points;  ///< GeoJSON of surveyed objects
  std::string calibration;   ///< what an earlier flight learnt of the camera
};

/// --known-points, --calibration.
void add_prior_options(CLI::App& program, PriorFiles& files);

/// Reads them over `config`. Throws std::runtime_error naming the file and the reason.
void apply_priors(const PriorFiles& files, GeolocatorConfig& config);

/// --out, --raw, --picture.
void add_output_options(CLI::App& program, OutputFiles& files);

/// Parses; nullopt where the program is to go on, otherwise its exit status (0 after --help).
std::optional<int> parse(CLI::App& program, int argc, char** argv);

/// Runs `step`; whatever it throws is told on stderr after the program's name. nullopt where it did not
/// throw.
std::optional<int> guard(const char* program, int status, const std::function<void()>& step);

}  // namespace geoloc::apps
