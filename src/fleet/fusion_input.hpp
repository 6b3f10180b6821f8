// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "fleet/fleet_flight.hpp"
#include "fleet/map_solver.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc {

/// Flights in the fleet's frame. Objects are called by the flight's model and their place in it.
struct FusionInput {
  std::vector<FlightSummary> summaries;
  std::vector<std::size_t> numbers;            ///< of the summaries, among FusedMap::flights
  std::vector<FlightModel> models;             ///< of the flights
  std::vector<std::vector<FlightPart>> parts;  ///< of each flight

  void erase(std::size_t flight) {
    models.erase(models.begin() + static_cast<std::ptrdiff_t>(flight));
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(flight));
  }

  const FlightPart& part_of(const Contribution& member) const {
    std::size_t part = 0;
    while (!parts[member.flight][part].has(member.object)) ++part;
    return parts[member.flight][part];
  }
};

/// Begins the map: its frame, and its flights. Those that are too far are in it alone.
FusionInput prepare_fusion(const Fleet& fleet, const FusionConfig& config, FusedMap& map);

}  // namespace geoloc
