// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/object_ids.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace geoloc {
namespace {

/// Entries of a flight beyond twice its objects are of objects that it no longer has.
constexpr std::size_t kSpareEntries = 1000;

/// An object of the map may be called by an id that some of its contributions had.
struct Claim {
  std::size_t contributions;
  std::uint64_t id;
  std::size_t object;  // place in the map

  bool operator<(const Claim& other) const {  // the strongest first
    return std::tuple(other.contributions, id, object) < std::tuple(contributions, other.id, other.object);
  }
};

std::uint64_t id_in_flight(const Fleet& fleet, const FusedMap& map, const Contribution& contribution) {
  return fleet.at(map.flights[contribution.flight].identity.flight).objects[contribution.object].id;
}

std::vector<Claim> claims_of(const Fleet& fleet, const ObjectIds& ids, const FusedMap& map) {
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    std::map<std::uint64_t, std::size_t> counts;
    for (const Contribution& contribution : map.objects[i].contributions) {
      const auto flight = ids.of.find(map.flights[contribution.flight].identity.flight);
      if (flight == ids.of.end()) continue;
      const auto known = flight->second.find(id_in_flight(fleet, map, contribution));
      if (known != flight->second.end()) ++counts[known->second];
    }
    for (const auto& [id, count] : counts) claims.push_back({count, id, i});
  }
  std::sort(claims.begin(), claims.end());
  return claims;
}

void note(const Fleet& fleet, const FusedMap& map, ObjectIds& ids) {
  for (const FusedObject& object : map.objects) {
    for (const Contribution& contribution : object.contributions)
      ids.of[map.flights[contribution.flight].identity.flight][id_in_flight(fleet, map, contribution)] =
          object.id;
  }
}

/// What a flight that tells of ever new objects may take of the memory is bounded.
void forget_spare(const Fleet& fleet, ObjectIds& ids) {
  for (const auto& [flight, summary] : fleet) {
    const auto known = ids.of.find(flight);
    if (known == ids.of.end() || known->second.size() <= 2 * summary.objects.size() + kSpareEntries) continue;
    std::map<std::uint64_t, std::uint64_t> kept;
    for (const FlightSummary::Object& object : summary.objects) {
      const auto entry = known->second.find(object.id);
      if (entry != known->second.end()) kept.insert(*entry);
    }
    known->second = std::move(kept);
  }
}

}  // namespace

void keep_ids(const Fleet& fleet, ObjectIds& ids, FusedMap& map) {
  for (FusedObject& object : map.objects) object.id = 0;
  std::set<std::uint64_t> given;
  for (const Claim& claim : claims_of(fleet, ids, map)) {
    FusedObject& object = map.objects[claim.object];
    if (object.id == 0 && given.insert(claim.id).second) object.id = claim.id;
  }
  for (FusedObject& object : map.objects) {
    if (object.id == 0) object.id = ids.next++;
  }
  note(fleet, map, ids);
  forget_spare(fleet, ids);
  std::sort(map.objects.begin(), map.objects.end(),
            [](const FusedObject& a, const FusedObject& b) { return a.id < b.id; });
}

}  // namespace geoloc
