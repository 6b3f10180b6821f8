// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geoloc/sim/flight/flight.hpp"
#include "support/source_tree.hpp"

namespace geoloc::sim {

inline std::filesystem::path flight_folder() {
  return source_tree() / "data/flights";
}

inline Flight load(const std::string& name) {
  return load_flight(flight_folder(), name);
}

}  // namespace geoloc::sim
