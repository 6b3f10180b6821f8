// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibration/landmark.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "tracking/look.hpp"

namespace geoloc {

/// What the ground says of an object near `place`: that it stands on the plane that touches the ground there,
/// z = h + slope (x - place), give or take the ground's sigma, or `least_sigma_m` where that is more.
PointInformation ground_prior(const GroundModel& ground, const Eigen::Vector2d& place, double least_sigma_m);

/// Where the look's ray meets the ground, its height counted from the level ground; where it does not meet
/// it, the ground at the look's own place.
Point ground_point(const Look& look, const GroundModel& ground, double max_range_m);

/// Looks at what moves on the ground, placed where their rays meet it.
void place_on_ground(std::vector<Look>& looks, const GroundModel& ground, double max_range_m);

/// The look's place where its ray is `height_m` above the level ground.
void place_at_height(Look& look, double height_m);

}  // namespace geoloc
