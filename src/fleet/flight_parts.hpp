// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// Time on the host's clock, which is the same for all parts of a flight.
inline HostTime host_time(const FlightRun& run, VehicleTime at) {
  return run.booted_at + at.time_since_epoch();
}

/// Places of summaries that are parts of one flight: of the same name, or else of the same vehicle's same
/// boot. Parts follow each other in time; a summary that overlaps one before it is none, since the same
/// frames must not count twice. Flights are in the order of their first summary in the list, parts in that of
/// time.
std::vector<std::vector<std::size_t>> flights_of_parts(const std::vector<FlightSummary>& summaries);

}  // namespace geoloc
