// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "fleet/map_solver.hpp"

namespace geoloc {

/// Flights that are connected by objects of the map, over any number of others, and those objects.
struct FlightGroup {
  std::vector<std::size_t> flights;
  std::vector<std::size_t> objects;  ///< of two contributions or more
};

/// Groups of flights that have such objects; a flight that shares none is in none.
inline std::vector<FlightGroup> connected_flights(std::size_t flights, const std::vector<Members>& objects) {
  std::vector<std::size_t> parent(flights);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t flight) {
    while (parent[flight] != flight) flight = parent[flight] = parent[parent[flight]];
    return flight;
  };
  for (const Members& members : objects) {
    for (const Contribution& member : members) parent[root(member.flight)] = root(members.front().flight);
  }
  std::vector<FlightGroup> by_root(flights), groups;
  for (std::size_t flight = 0; flight < flights; ++flight) by_root[root(flight)].flights.push_back(flight);
  for (std::size_t object = 0; object < objects.size(); ++object) {
    if (objects[object].size() > 1) by_root[root(objects[object].front().flight)].objects.push_back(object);
  }
  for (FlightGroup& group : by_root) {
    if (!group.objects.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace geoloc
