// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/detection_rate.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// How well the frame would show an object, 0..1.
double chance_to_show(const RestingObject& track, const std::vector<Look>& looks, const JointFrame& frame,
                      const FrameShift& shift, const JointTrackerConfig& config);

/// Holds it against the objects that the frame should show and does not, and counts how often confirmed ones
/// are found. Notes in each track how likely the frame was to show it. True where two tracks may turn out to
/// be one and are known well enough to be compared: they do not wait for the next solution.
bool weigh_missed(const std::vector<Look>& looks, const JointFrame& frame, const FrameShift& shift,
                  const JointTrackerConfig& config, DetectionRate& detection_rate, TrackTable& tracks);

}  // namespace geoloc
