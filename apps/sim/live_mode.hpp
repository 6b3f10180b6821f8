// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "geoloc/sim/live/link_faults.hpp"
#include "run_options.hpp"

namespace geoloc::sim {

struct LiveOptions {
  std::string udp = "127.0.0.1:14550";
  std::uint16_t rtsp_port = 8554;
  double speed = 1.0;
  double wait_s = 60.0;
  int distractors = 20;
  std::string truth_file;
  LinkFaults link;
  std::optional<double> reboot_at_s;
};

void add_live_options(CLI::App& program, LiveOptions& options);

/// Flies live until the flight is over or the program is interrupted; its exit status.
int run_live_mode(const RunOptions& run, const LiveOptions& options, std::uint64_t seed);

}  // namespace geoloc::sim
