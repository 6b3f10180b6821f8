// SPDX-License-Identifier: Apache-2.0
#include "tracking/sleep_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/footprint.hpp"
#include "tracking/identity.hpp"

namespace geoloc {
namespace {

/// Out of view for so long, an object may sleep; the next solution has compared it with others by then.
constexpr double kAwakeFor_s = 2.0;
/// The same where the frames' time is not proven yet: it may still turn out that looks have to be taken out,
/// which are remembered for less.
constexpr double kDoubtedFor_s = 10.0;
/// One that was never confirmed may be forgotten after so long, where more objects than that are awake.
constexpr double kRememberedFor_s = 60.0;
constexpr std::size_t kManyAwake = 200;
/// What the area has to spare: sleeping objects are where they were when they were last brought up to date.
constexpr double kSpare_m = 2.0, kSpareSigmas = 3.0;

}  // namespace

Eigen::AlignedBox2d area_in_view(const JointFrame& frame, const SharedErrorEstimate& errors,
                                 double sigma_ground_m, double sigma_time_s) {
  const FrameShift shift = shift_by(errors.calibration, frame.drift, frame.ground_height_m);
  const double height_m = std::max(0.0, frame.view.enu_from_camera.translation.z() - shift.level_m);
  const double variance_m2 = errors.drift_root.topRows<2>().squaredNorm() +
                             height_m * height_m * errors.calibration_root.topRows<3>().squaredNorm();
  const double spare_m = kSpare_m + kSpareSigmas * std::sqrt(variance_m2) +
                         kSpareSigmas * sigma_time_s * frame.view.vehicle.velocity_in_enu.head<2>().norm();
  Eigen::AlignedBox2d area = footprint(frame.projector, frame.view, sigma_ground_m);
  area.translate(shift.correction());
  area.min().array() -= spare_m;
  area.max().array() += spare_m;
  return area;
}

void wake_near(const Eigen::AlignedBox2d& area, const JointFrame& frame, SharedErrorEstimate& errors,
               PublishedTracks& published, SleepingObjects& sleeping, TrackTable& awake) {
  for (const SleepingObjects::Key key : sleeping.near(area)) {
    if (awake.is_full()) break;
    if (!area.contains(sleeping.position_of(key))) continue;
    const std::uint64_t id = sleeping.id_of(key);
    RestingObject& object = awake.insert(id);
    sleeping.wake(key, errors.drift, object);
    object.track = *published.find(id, object.published_at);
    object.sigma_height_m = object.track.height->sigma_m;
    refresh(object, errors, frame.span);
  }
  for (RestingObject& object : awake) {
    if (area.contains(Eigen::Vector2d(object.position_in_enu.head<2>()))) object.last_near = frame.time();
  }
}

bool may_sleep(const RestingObject& object, const TrackTable& awake, VehicleTime now, VehicleTime proven_at,
               double merge_radius_m) {
  const bool is_decided = object.is_confirmed() && object.is_compared && !object.is_known;
  const double away_s = seconds(now - object.last_near);
  const double least_away_s = object.last_look > proven_at ? kDoubtedFor_s : kAwakeFor_s;
  if (!is_decided || away_s < least_away_s) return false;
  for (const RestingObject& other : awake) {
    if (&other != &object && are_not_told_apart(object, other, 2.0 * merge_radius_m)) return false;
  }
  return true;
}

bool may_be_forgotten(const RestingObject& object, const TrackTable& awake, VehicleTime now) {
  return awake.size() > kManyAwake && !object.was_confirmed &&
         seconds(now - object.last_near) > kRememberedFor_s;
}

Track published_track(const RestingObject& object, double ground_height_above_home_m) {
  Track track = object.track;
  track.height =
      HeightEstimate{object.position_in_enu.z() + ground_height_above_home_m, object.sigma_height_m};
  return track;
}

}  // namespace geoloc
