// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "geoloc/sim/live/link_faults.hpp"

namespace geoloc::sim {

/// What live runs are chosen by, beside RunOptions.
struct LiveOptions {
  std::string udp;  ///< HOST:PORT; empty: this computer's port of the autopilot
  std::uint16_t rtsp_port = 8554;
  double speed = 1.0;
  double wait_s = 60.0;
  int distractors = 20;
  std::string truth_file;
  LinkFaults link;
  std::optional<double> reboot_at_s;
};

void add_live_options(CLI::App& program, LiveOptions& options);

}  // namespace geoloc::sim
