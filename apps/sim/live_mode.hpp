// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/live_options.hpp"
#include "sim/run_options.hpp"

namespace geoloc::sim {

/// Flies live until the flight is over or the program is interrupted; its exit status.
int run_live_mode(const RunOptions& run, const LiveOptions& options, std::uint64_t seed);

}  // namespace geoloc::sim
