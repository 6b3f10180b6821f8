// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "common/output_files.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"

namespace geoloc::apps {

inline constexpr const char* kLevelGround = "plane";
inline constexpr const char* kFreeGround = "free";

/// What is known of the ground.
struct GroundOptions {
  std::string ground = kLevelGround;  ///< or free, or a file
  std::optional<double> sigma_m;
};

/// Whether the ground is an elevation model.
bool is_file(const GroundOptions& options);

/// --ground, --ground-sigma-m.
void add_ground_options(CLI::App& program, GroundOptions& options);
void add_ground_sigma_option(CLI::App& program, GroundOptions& options);

/// The elevation model, if there is one, as an input for check_outputs().
NamedFiles files_of(const GroundOptions& options);

/// The ground over `config`; of a file, what is to be told the user of it. Throws std::runtime_error naming
/// the file or the option and the reason.
[[nodiscard]] std::string apply_ground(const GroundOptions& options, GeolocatorConfig& config);

/// All but the file.
void apply_ground_sigma(const GroundOptions& options, GeolocatorConfig& config);

}  // namespace geoloc::apps
