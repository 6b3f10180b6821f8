// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calibration/height_log.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/state/vehicle_state.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// A rangefinder's reading as an observation of how much higher above the level ground the vehicle is than it
/// reports.
struct HeightReading {
  double value_m;
  double variance_m2;
};

/// The beam leaves along the body's down axis and meets the ground where its length ends; `ground` says how
/// high that stands. nullopt where the vehicle tilts too much, or would be lower than it flies.
/// level_above_home_m: of the level ground.
std::optional<HeightReading> height_reading(double distance_m, const VehicleState& vehicle,
                                            double level_above_home_m, const GroundModel& ground);

/// Whether a reading agrees with what is known of the height. Before looks tell anything of it, any does.
bool agrees(const HeightReading& reading, const SharedErrorEstimate& errors, const NodeSpan& now);

}  // namespace geoloc
