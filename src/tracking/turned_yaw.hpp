// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tracking/joint_frame.hpp"
#include "tracking/look.hpp"
#include "tracking/look_matcher.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// How well the objects known so far explain a frame.
struct FrameFit {
  double cost =
      0.0;  ///< -2 ln of the probability of its looks, and of there being no others, but for a constant
  double seen = 0.0;    ///< known objects, each as likely as it exists
  double missed = 0.0;  ///< the same that it should show
};

/// `explanation`: by LookMatcher::try_to_explain().
FrameFit fit_of(const std::vector<Look>& looks, const Explanation& explanation, const JointFrame& frame,
                const FrameShift& shift, const JointTrackerConfig& config, double detection_probability,
                const TrackTable& tracks);

/// Whether it misses so much of what it should show that the vehicle may have told its yaw wrong.
bool is_doubtful(const FrameFit& stated);

/// Whether a frame was taken the other way round than the vehicle tells: as stated it misses what it should
/// show, and turned it shows that.
bool is_rather_turned(const FrameFit& stated, const FrameFit& turned);

}  // namespace geoloc
