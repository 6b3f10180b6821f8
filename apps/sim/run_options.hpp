// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/sim/flight/run_settings.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "sim/gimbal_options.hpp"

namespace geoloc::sim {

/// What recordings and live runs are chosen by.
struct RunOptions {
  std::string flight = "stock_path1";
  std::string autopilot = "ardupilot";
  std::optional<std::string> data_folder;
  double raised_m = 0.0;
  std::string jump;  ///< its name; empty: none
  AttitudeNoise attitude_noise;
  std::optional<double> telemetry_rate_hz;
  std::array<int, 2> image_size_px{1280, 720};
  double horizontal_fov_deg = 70.0;
  std::array<double, 5> distortion{};
  bool uncalibrated_lens = false;
  GimbalOptions gimbal;
  std::string zoom;      ///< as "1..4"; empty: none
  bool has_sei = false;  ///< telemetry in the video's frames
  RunSettings settings;
};

void add_run_options(CLI::App& program, RunOptions& options);

/// The options as settings, the seed given apart. Throws std::invalid_argument naming every problem.
RunSettings to_settings(const RunOptions& options, std::uint64_t seed);

/// Throws std::runtime_error that says where flights were looked for, or which there are.
Flight load_flight(const RunOptions& options);

/// Whether the vehicle is PX4, on whichever of its links.
bool is_px4(const RunOptions& options);

/// The flight with the gimbal and the zoom that are asked for, and their errors by the run's seed.
Flight with_moving_camera(Flight flight, const RunOptions& options, const RunSettings& settings);

}  // namespace geoloc::sim
