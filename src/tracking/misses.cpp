// SPDX-License-Identifier: Apache-2.0
#include "tracking/misses.hpp"

#include <cmath>

#include "tracking/identity.hpp"
#include "tracking/visibility.hpp"

namespace geoloc {
namespace {

/// A younger track that may be the same object has this frame's look: begun when the vehicle came back with
/// another drift, it would outlive the older one, and all that this one knows. nullptr: there is none.
const RestingObject* seen_as(const RestingObject& track, const TrackTable& tracks, double merge_radius_m) {
  if (!track.is_confirmed()) return nullptr;
  for (const RestingObject& other : tracks) {
    const bool is_young = other.track.id > track.track.id && other.track.hits <= kHitsToCompare;
    if (is_young && other.is_seen && are_not_told_apart(track, other, merge_radius_m)) return &other;
  }
  return nullptr;
}

/// The object where this frame would show it.
ShownObject shown_object(const RestingObject& track, const std::vector<Look>& looks,
                         const FrameShift& shift) {
  ShownObject object;
  object.position_in_enu = shift.shown(track.position_in_enu);
  object.sigma_m = std::sqrt(track.own_covariance.topLeftCorner<2, 2>().trace() +
                             track.sensitivity.topRows<2>().squaredNorm());
  object.size_m = track.size_m;
  // Its look's is as good and known already.
  if (track.look) object.ground_per_pixel_m = looks[*track.look].ground_per_pixel_m;
  return object;
}

bool is_to_be_compared(const RestingObject& track) {
  return track.track.hits >= kHitsToCompare && !track.is_compared;
}

}  // namespace

double chance_to_show(const RestingObject& track, const std::vector<Look>& looks, const JointFrame& frame,
                      const FrameShift& shift, const JointTrackerConfig& config) {
  return visibility(shown_object(track, looks, shift), frame.projector, frame.view, config.sigma_px,
                    config.smallest_object_px);
}

bool weigh_missed(const std::vector<Look>& looks, const JointFrame& frame, const FrameShift& shift,
                  const JointTrackerConfig& config, DetectionRate& detection_rate, TrackTable& tracks) {
  bool may_be_twins = false;
  for (RestingObject& track : tracks) {
    if (track.is_in_doubt) {
      may_be_twins = may_be_twins || is_to_be_compared(track);
      continue;
    }
    if (track.is_seen && !track.is_confirmed()) continue;
    const double probability =
        chance_to_show(track, looks, frame, shift, config) * detection_rate.probability();
    if (probability <= 0.0) continue;
    track.detection_probability = probability;
    if (!track.is_seen) {
      if (const RestingObject* const other = seen_as(track, tracks, config.merge_radius_m)) {
        may_be_twins = may_be_twins || is_to_be_compared(*other);
        continue;
      }
      track.existence.miss(probability);
    }
    if (track.is_confirmed())
      detection_rate.count(track.is_seen ? DetectionRate::Outcome::kFound : DetectionRate::Outcome::kMissed);
  }
  return may_be_twins;
}

}  // namespace geoloc
