// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/fleet/flight_summary.hpp"
#include "json_members.hpp"

// What makes a summary a part of a flight, as JSON.
namespace geoloc::io {

ordered_json part_to_json(const FlightSummary::Part& part);
FlightSummary::Part part_from_json(const std::string& name, const json& document);

}  // namespace geoloc::io
