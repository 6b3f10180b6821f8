// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "import/exposure_times.hpp"
#include "import/flight_plan.hpp"

// What people are told of a plan: how good its pictures' metadata are, and what had to be assumed.
namespace geoloc::apps {

/// Whether the picture tells how its camera looked.
bool tells_camera(const io::StillAttitude& attitude);

/// What their heights count from.
void note_heights(const std::vector<TimedStill>& stills, FlightPlan& plan);

/// Their solutions, as DJI numbers them.
void note_rtk(const std::vector<TimedStill>& stills, FlightPlan& plan);

/// Pictures whose focal length is not that of most.
void note_zoom(FlightPlan& plan);

/// How the cameras looked that tell nothing of it, and pictures that contradict themselves.
/// `told_pitch_deg`: by the user.
void assume_attitudes(const std::vector<TimedStill>& stills, std::optional<double> told_pitch_deg,
                      FlightPlan& plan);

}  // namespace geoloc::apps
