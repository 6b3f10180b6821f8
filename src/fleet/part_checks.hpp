// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fleet/named_faults.hpp"
#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// What makes the part of a flight unusable that a summary says it is: it can be joined with others where
/// there is nothing. `shared_count`: errors that the summary's objects share.
void check_part(const FlightSummary::Part& part, Eigen::Index shared_count, NamedFaults& faults);

}  // namespace geoloc
