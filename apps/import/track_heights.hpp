// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/logs/flight_log.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::apps {

/// The log's positions with their heights above home: as told, or absolute ones less home's. What was taken
/// for home is added to `assumptions`. Throws std::runtime_error where there are no heights.
std::vector<PositionSample> positions_above_home(const io::FlightLog& log,
                                                 std::optional<double> told_take_off_height_m,
                                                 std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
