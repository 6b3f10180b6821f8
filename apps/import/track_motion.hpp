// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/logs/flight_log.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::apps {

/// The log's velocities at its positions; where it tells none, what the positions changed by within a second.
void take_velocities(const std::vector<io::LoggedVelocity>& told, std::vector<PositionSample>& positions);

/// Level attitudes that look where the vehicle flies to; while it hovers, where it flew to before.
std::vector<AttitudeSample> level_towards_course(const std::vector<PositionSample>& positions);

/// Without samples that repeat the place before: a receiver that is slower than the log. Of a vehicle that
/// hovers, one every half second stays.
void drop_held_positions(std::vector<PositionSample>& positions);

/// Where coordinates or heights are rounded coarsely, takes out of that what a smooth movement tells
/// (unrounded), and notes it.
void take_out_rounding(std::vector<PositionSample>& positions, std::vector<std::string>& notes);

}  // namespace geoloc::apps
