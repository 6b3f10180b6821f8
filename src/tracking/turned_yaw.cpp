// SPDX-License-Identifier: Apache-2.0
#include "tracking/turned_yaw.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/misses.hpp"

namespace geoloc {
namespace {

/// One frame in a thousand is turned, in units of a squared distance.
constexpr double kCostOfTurn = 13.8;
/// A frame that misses so few objects, and so small a share of them, shows what it should, whatever else it
/// shows: over a field of objects in rows, new ones may stand as known ones do on the other side.
constexpr double kFewMissed = 1.5, kSmallShare = 0.25;
/// Fewer objects say nothing: a single look falls on one of many sooner or later.
constexpr double kLeastSeen = 1.5;

bool is_shown(std::size_t row, const Explanation& explanation) {
  const auto& matches = explanation.match_of_look;
  return std::any_of(matches.begin(), matches.end(), [row](const auto& match) { return match.track == row; });
}

}  // namespace

FrameFit fit_of(const std::vector<Look>& looks, const Explanation& explanation, const JointFrame& frame,
                const FrameShift& shift, const JointTrackerConfig& config, double detection_probability,
                const TrackTable& tracks) {
  FrameFit fit;
  fit.cost = explanation.cost;
  for (std::size_t row = 0; row < tracks.size(); ++row) {
    const RestingObject& track = tracks[row];
    const double exists = track.existence.probability();
    if (is_shown(row, explanation)) {
      fit.seen += exists;
      continue;
    }
    const double found = exists * detection_probability * chance_to_show(track, looks, frame, shift, config);
    fit.cost -= 2.0 * std::log(1.0 - found);
    fit.missed += found;
  }
  return fit;
}

bool is_doubtful(const FrameFit& stated) {
  return stated.missed > std::min(kFewMissed, kSmallShare * (stated.seen + stated.missed));
}

bool is_rather_turned(const FrameFit& stated, const FrameFit& turned) {
  return is_doubtful(stated) && turned.missed < stated.missed && turned.seen > kLeastSeen &&
         turned.cost + kCostOfTurn < stated.cost;
}

}  // namespace geoloc
