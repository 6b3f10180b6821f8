// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/arrowhead.hpp"
#include "calibration/settled_sums.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look_matcher.hpp"
#include "tracking/resting_object.hpp"
#include "tracking/track_table.hpp"

// Which tracks are one object, and which object is two.
namespace geoloc {

/// Near each other, and never seen side by side.
bool are_not_told_apart(const RestingObject& a, const RestingObject& b, double merge_radius_m);

/// Covariance of the difference of two tracks' positions [m^2].
PointMatrix covariance_of_difference(const RestingObject& a, const RestingObject& b,
                                     const ArrowheadSolver::Solution& solution, const FrameNoise& noise);

/// Perhaps one object: not told apart, and known well enough to tell.
bool may_be_one(const RestingObject& a, const RestingObject& b, const ArrowheadSolver::Solution& solution,
                const FrameNoise& noise, const JointTrackerConfig& config);

/// What a frame tells of objects that are near each other. Two tracks that two looks of it made, or were
/// matched to, are two objects; one look where both should be seen speaks for one. Where two neighbours were
/// taken for one object for a while, the older track is made of looks at both and lies between them. Once it
/// is seen beside the younger one its looks are drawn to one side; then it begins anew from the present one,
/// since the sums do not tell which look showed which.
void tell_neighbours_apart(const std::vector<Look>& looks, const Explanation& explanation,
                           const SharedErrorEstimate& errors, double merge_radius_m, TrackTable& tracks,
                           SettledSums& settled);

}  // namespace geoloc
