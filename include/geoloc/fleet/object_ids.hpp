// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "geoloc/fleet/fusion.hpp"

namespace geoloc {

/// Which object of the fleet each flight's objects have been. An object of the map is known again by what it
/// is made of, so that it keeps its id from one fusion to the next, whatever flights come.
struct ObjectIds {
  std::map<std::string, std::map<std::uint64_t, std::uint64_t>> of;  ///< by flight, and its object's id
  std::uint64_t next = 1;                                            ///< no object had it, or a greater one
};

/// Gives the map's objects the ids that most of their contributions had, and new ones to those whose
/// contributions had none or lost theirs to an object with more of them. No id is given twice, or again after
/// it was another object's. `fleet`: that the map was made of. Objects are in order of their ids then.
void keep_ids(const Fleet& fleet, ObjectIds& ids, FusedMap& map);

}  // namespace geoloc
