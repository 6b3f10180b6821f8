// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/fleet/fusion.hpp"
#include "geoloc/io/output/flight_report.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// What the outputs call it.
const char* word_of(FlightVerdict verdict);

/// The fleet's objects as every output reports them; heights are above home where the fleet knows none.
std::vector<ObjectReport> report_objects(const FusedMap& map, const std::vector<std::string>& class_names);

/// What became of each flight. `fleet`: that the map was made of.
std::vector<FlightReport> report_flights(const FusedMap& map, const Fleet& fleet);

/// The FeatureCollection of docs/formats.md, with the flights that made it. `objects`: of the map, in its
/// order.
std::string fused_to_geojson(const FusedMap& map, const std::vector<ObjectReport>& objects);

/// A line per flight, for people: what became of it, its common error with sigma, and the reason.
std::string flights_to_table(const FusedMap& map);

}  // namespace geoloc::io
