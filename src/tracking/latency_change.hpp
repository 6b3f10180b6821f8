// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tracking/place_fit.hpp"
#include "tracking/waiting_frames.hpp"

namespace geoloc {

/// Frames up to a clock's step have one latency, and those since it another.
struct LatencyChange {
  double before_s;
  double after_s;
};

/// Which of the frames may be the first with the later latency, the last of them included: those from
/// `first_possible` on, before `first_certain`, may have either. As many as there are frames: none of them.
struct ChangeOfLatency {
  std::size_t first_possible;
  std::size_t first_certain;
  double lead;  ///< log likelihood of the likeliest one over that of "all frames have the later latency"
};

/// Compares the boxes of the frames with the places, and with those of the frames half a second before, by
/// the latency of each on either side of every frame at which the clock may have stepped. A clock that is set
/// ahead leaves a gap in the stamps.
ChangeOfLatency find_change(const WaitingFrames& frames, const LatencyChange& change, const PlaceFit& fit,
                            const std::vector<WatchedPlace>& places);

}  // namespace geoloc
