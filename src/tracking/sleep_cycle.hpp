// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "calibration/shared_error_estimate.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/published_tracks.hpp"
#include "tracking/sleeping_objects.hpp"
#include "tracking/track_table.hpp"

// Which objects are awake: those that frames may show, those that they showed a moment ago, and those that
// are not told apart from others. All others sleep, so that a frame costs what is in view and not what was
// ever seen.
namespace geoloc {

/// Objects that may be awake at a time: all, but for flights over very many.
inline int most_awake(const JointTrackerConfig& config) {
  return std::min(config.max_tracks, 20000);
}

/// East and north of what a frame may show, by all that is known of the shared errors; more while the frame's
/// time is in doubt.
Eigen::AlignedBox2d area_in_view(const JointFrame& frame, const SharedErrorEstimate& errors,
                                 double sigma_ground_m, double sigma_time_s);

/// Wakes the objects in the area, and notes which ones are near it.
void wake_near(const Eigen::AlignedBox2d& area, const JointFrame& frame, SharedErrorEstimate& errors,
               PublishedTracks& published, SleepingObjects& sleeping, TrackTable& awake);

/// Whether an object may sleep that no frame has shown for a while: nothing is to be decided about it.
/// proven_at: the last frame whose time was beyond doubt.
bool may_sleep(const RestingObject& object, const TrackTable& awake, VehicleTime now, VehicleTime proven_at,
               double merge_radius_m);

/// Whether an object that was never confirmed is to be forgotten, where there are too many of them.
bool may_be_forgotten(const RestingObject& object, const TrackTable& awake, VehicleTime now);

/// The object as it is reported; the level ground is so high above home.
Track published_track(const RestingObject& object, double ground_height_above_home_m);

}  // namespace geoloc
