// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "geoloc/sim/flight/simulated_detector.hpp"
#include "geoloc/sim/flight/terrain.hpp"
#include "sim/run_options.hpp"

namespace geoloc::sim {

struct RecordOptions {
  std::string folder;
  DetectorModel detector;
  Terrain terrain;
  bool has_rangefinder = false;
  bool has_video = false;
};

/// Adds --record and the noise model's options; returns the one that chooses this mode.
CLI::Option* add_record_options(CLI::App& program, RecordOptions& options);

/// Writes a recording, with video.mkv if asked for; the program's exit status.
int run_record_mode(const RunOptions& run, const RecordOptions& options, std::uint64_t seed);

}  // namespace geoloc::sim
