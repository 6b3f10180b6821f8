// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "fleet/fleet_flight.hpp"
#include "fleet/map_solver.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc {

/// A part of a flight to be associated: the flight's model, and the class of each of the part's objects.
struct AssociatedFlight {
  std::size_t number;  ///< of the flight
  const FlightModel& model;
  FlightPart part;
  std::vector<int> classes;
};

/// Which objects of the flights are one. One flight after another is laid onto the map of those before,
/// shifted as a whole to where most of its objects fit: by their relative positions objects are told apart at
/// centimetres, though all of a flight may be metres off. Two objects of one part are never one. The result
/// depends on the flights' order.
std::vector<Members> associate(const std::vector<AssociatedFlight>& flights, const FusionConfig& config);

}  // namespace geoloc
