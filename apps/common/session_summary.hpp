// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "common/session.hpp"
#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc::apps {

/// The flight so far, for fusion with others. `flight_id`: its name; empty: the time and place of its start,
/// which are the same live and replayed. `whole_flight`: the name of the flight that this is a part of;
/// empty: that of the vehicle's boot. nullopt before the first located frame, and where the method does not
/// know what its objects share.
std::optional<FlightSummary> summarize_session(const Session& session, const std::string& flight_id,
                                               const std::string& whole_flight);

}  // namespace geoloc::apps
