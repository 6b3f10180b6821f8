// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

inline std::filesystem::path flight_folder() {
  return std::filesystem::path(GEOLOC_SOURCE_DIR) / "data/flights";
}

inline Flight load(const std::string& name) {
  return load_flight(flight_folder(), name);
}

}  // namespace geoloc::sim
