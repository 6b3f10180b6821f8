// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "geoloc/io/recording/recording.hpp"
#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/sim/flight/run_settings.hpp"

namespace geoloc::sim {

/// Draws what the true camera saw of level ground at each of a recording's frames, and writes it as a video
/// whose time 0 is the first frame's stamp. `has_sei`: each frame carries the telemetry of its stamp. Throws
/// std::runtime_error where it cannot be written; the file appears whole or not at all.
void write_flight_video(const std::filesystem::path& file, const Flight& flight, const RunSettings& settings,
                        const std::vector<io::RecordedFrame>& frames, bool has_sei);

}  // namespace geoloc::sim
