// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibration/arrowhead.hpp"
#include "calibration/height_log.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geoloc/tracking/joint_estimate.hpp"
#include "tracking/published_tracks.hpp"
#include "tracking/sleeping_objects.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// All that the joint method knows of objects at rest and of the errors that they share.
struct JointState {
  const ArrowheadSolver& solver;
  const SharedErrorEstimate& errors;
  const HeightLog& heights;
  const TrackTable& awake;
  const SleepingObjects& sleeping;
  const PublishedTracks& published;
};

/// Solves for the head with copies of what a solution changes, so that the estimator goes on as if nothing
/// had been asked. `ground_height_above_home_m`: the projector's. nullopt where rounding left no solution.
std::optional<JointEstimate> joint_estimate(const JointState& state, double ground_height_above_home_m);

}  // namespace geoloc
