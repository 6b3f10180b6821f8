// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/fleet/fusion.hpp"
#include "geoloc/tracking/known_points.hpp"

namespace geoloc::apps {

/// The name under which the survey stands among the flights.
inline constexpr const char* kSurvey = "known-points";

/// Surveyed points as one more flight, which is off by nothing in common: what the flights are off by is held
/// against it like against each other's, so that a survey that is wrong is named, too. It has seen nothing:
/// its objects have no hits and no times. `points`: one at least.
FlightSummary summary_of_survey(const std::vector<KnownPoint>& points);

/// Takes out the objects that no flight has seen: points that the survey alone tells of.
void drop_unseen(FusedMap& map);

/// Whether the survey tells where the object is.
bool is_surveyed(const FusedMap& map, const FusedObject& object);

}  // namespace geoloc::apps
