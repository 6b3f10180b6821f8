// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "geoloc/sim/live/gimbal_flight.hpp"

namespace geoloc::sim {

/// A gimbal as it is asked for on the command line.
struct GimbalOptions {
  std::string aim;  ///< empty: the camera is fixed to the body
  std::string yaw = "follow";
  std::string told_yaw = "nose";
  std::string message = "285";
  bool has_wrong_flag = false;
  bool tells_set_point = false;
  bool is_perfect = false;
};

/// Adds --gimbal and what goes with it; `mount_pitch` excludes it.
void add_gimbal_options(CLI::App& program, GimbalOptions& options, CLI::Option* mount_pitch);

/// nullopt where none is asked for.
std::optional<GimbalSettings> to_settings(const GimbalOptions& options);

}  // namespace geoloc::sim
