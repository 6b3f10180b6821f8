// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibration/shared_error_estimate.hpp"
#include "tracking/place_fit.hpp"
#include "tracking/track_table.hpp"
#include "tracking/tracker.hpp"

namespace geoloc {

/// Lists where a frame should show the objects. Known are those that were begun while the latency was proven
/// (`proven_at`: the last frame by which it was): whatever was begun since is of the latency in question.
void list_places(const TrackTable& tracks, const SharedErrorEstimate& errors, const DriftConfig& drift,
                 const LocatedFrame& frame, VehicleTime proven_at, std::vector<WatchedPlace>& places);

}  // namespace geoloc
