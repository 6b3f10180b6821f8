// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

/// The flight as PX4 would have told it: heartbeats that name PX4, and ESTIMATOR_STATUS in place of
/// EKF_STATUS_REPORT, with the accuracy that the receiver claimed last. What both tell alike stays;
/// ArduPilot's texts are left out.
Flight as_px4(const Flight& flight);

}  // namespace geoloc::sim
