// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fleet/fleet_flight.hpp"
#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// A part of a flight, ready to be joined: `model` is that of its summary.
struct PartModel {
  std::size_t number;  ///< of the summary
  const FlightSummary& summary;
  FlightModel model;
};

/// Parts of one flight, in the order of time, as one flight: what they share is estimated from all of them,
/// and what they were told before the flight counts once (docs/fleet.md). nullopt where they contradict each
/// other so much that they are likelier to be of different flights.
std::optional<FleetFlight> join_parts(const std::vector<PartModel>& parts);

}  // namespace geoloc
