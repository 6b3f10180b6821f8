// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/sim/flight/terrain.hpp"

namespace geoloc::sim {

/// The same flight of a vehicle that tells ten times a second (DISTANCE_SENSOR) how far the ground is that it
/// meets along its down axis, up to 60 m: with noise of 5 cm and 1 %, a scale that is off by 1 % (1 sigma,
/// drawn for the flight), and one reading in fifty that is anything.
Flight with_rangefinder(const Flight& flight, const Terrain& terrain, std::uint64_t seed);

}  // namespace geoloc::sim
