// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/arrowhead.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geoloc/calibration/flight_state.hpp"

namespace geoloc {

/// The unknowns of a solution that outlast the run. Those that the prior froze are left out, and those that
/// are no longer what they were at the run's start: the latency once a clock stepped, the first drift once it
/// began anew. `errors`: that the solution was found with.
FlightState flight_state(const ArrowheadSolver& solver, const ArrowheadSolver::Solution& solution,
                         const SharedErrorEstimate& errors);

}  // namespace geoloc
