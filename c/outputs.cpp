// SPDX-License-Identifier: Apache-2.0
#include "outputs.hpp"

#include <algorithm>

namespace geoloc::c {
namespace {

void copy_upper(const Eigen::Matrix2d& covariance, double (&values)[3]) {
  values[0] = covariance(0, 0);
  values[1] = covariance(0, 1);
  values[2] = covariance(1, 1);
}

/// WGS84 of a place in the local frame.
template <typename Structure>
void place(const Eigen::Vector2d& position_in_enu, const LocalFrame& frame, Structure& structure) {
  const Geodetic where = frame.to_geodetic(position_in_enu);
  structure.latitude_deg = where.latitude_deg;
  structure.longitude_deg = where.longitude_deg;
  structure.east_m = position_in_enu.x();
  structure.north_m = position_in_enu.y();
}

}  // namespace

geoloc_outcome to_c(const FrameOutcome& outcome) {
  return {outcome.captured_at.time_since_epoch().count(), outcome.captured_at_host.time_since_epoch().count(),
          static_cast<int32_t>(outcome.fate)};
}

geoloc_object to_c(const Track& track, const LocalFrame& frame) {
  geoloc_object object{};
  object.id = track.id;
  place(track.position_in_enu.mean, frame, object);
  copy_upper(track.position_in_enu.covariance, object.covariance_m2);
  if (track.height) {
    object.has_height = 1;
    object.height_above_home_m = track.height->above_home_m;
    object.sigma_height_m = track.height->sigma_m;
  }
  if (track.velocity_in_enu) {
    object.has_velocity = 1;
    object.velocity_in_enu_mps[0] = track.velocity_in_enu->mean.x();
    object.velocity_in_enu_mps[1] = track.velocity_in_enu->mean.y();
    copy_upper(track.velocity_in_enu->covariance, object.velocity_covariance_m2ps2);
  }
  object.confidence = track.confidence();
  object.first_seen_utc_ns = track.first_seen.time_since_epoch().count();
  object.last_seen_utc_ns = track.last_seen.time_since_epoch().count();
  object.class_id = track.class_id();
  object.hits = track.hits;
  object.is_confirmed = track.status == TrackStatus::kConfirmed ? 1 : 0;
  return object;
}

geoloc_fix to_c(const LocatedDetection& located, const LocalFrame& frame) {
  const Detection& detection = located.detection;
  geoloc_fix fix{};
  fix.detection = {detection.box.x,      detection.box.y,    detection.box.width, detection.box.height,
                   detection.confidence, detection.class_id, detection.sigma_px};
  place(located.fix.position_in_enu, frame, fix);
  for (int i = 0; i < 4; ++i) fix.ground_from_pixel_mppx[i] = located.fix.ground_from_pixel(i / 2, i % 2);
  fix.range_m = located.fix.range_m;
  return fix;
}

geoloc_pose to_c(const FrameView& view) {
  const Rigid3d& pose = view.enu_from_camera;
  geoloc_pose result{};
  std::copy_n(pose.translation.data(), 3, result.position_in_enu_m);
  // The view is lifted so that the ground lies in the projector's plane.
  result.position_in_enu_m[2] -= view.lifted_m;
  const double wxyz[4] = {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  std::copy_n(wxyz, 4, result.enu_from_camera_wxyz);
  result.latency_s = view.latency_s;
  return result;
}

geoloc_calibration to_c(const Calibration& calibration) {
  using Index = CalibrationIndex;
  geoloc_calibration result{};
  for (int axis = 0; axis < 3; ++axis) {
    result.boresight_rad[axis] = calibration.boresight_rad()[axis];
    result.sigma_boresight_rad[axis] = calibration.sigma(Index::kBoresight + axis);
  }
  result.latency_s = calibration.latency_s();
  result.sigma_latency_s = calibration.sigma(Index::kLatency);
  result.height_m = calibration.height_m();
  result.sigma_height_m = calibration.sigma(Index::kHeight);
  result.focal_ratio = calibration.focal_ratio();
  result.sigma_focal_ratio = calibration.focal_ratio() * calibration.sigma(Index::kFocal);
  result.position_lag_s = calibration.position_lag_s();
  result.sigma_position_lag_s = calibration.sigma(Index::kPositionLag);
  for (int axis = 0; axis < 2; ++axis) {
    result.offset_m[axis] = calibration.offset_m()[axis];
    result.sigma_offset_m[axis] = calibration.sigma(Index::kOffset + axis);
  }
  return result;
}

geoloc_counters counters_of(const Geolocator& geolocator) {
  const Geolocator::Counters& frames = geolocator.counters();
  const StateProvider::Counters state = geolocator.state().counters();
  const TrackCounters& tracks = geolocator.track_counters();
  geoloc_counters result{};
  result.frames = frames.frames;
  std::copy(frames.frames_by_fate.begin(), frames.frames_by_fate.end(), result.frames_by_fate);
  result.frames_waiting = geolocator.frames_waiting();
  result.detections = frames.detections;
  result.detections_dropped = frames.detections_dropped;
  result.detections_at_edge = frames.detections_at_edge;
  result.attitudes = state.attitudes;
  result.positions = state.positions;
  result.gimbals = state.gimbals;
  result.focal_lengths = state.focal_lengths;
  result.ranges = frames.ranges;
  result.duplicates = state.duplicates;
  result.stale = state.stale;
  result.invalid = state.invalid;
  result.out_of_range = state.out_of_range;
  result.too_far = state.too_far;
  result.reboots = state.reboots;
  result.maps_void = frames.maps_void;
  result.tracks_created = tracks.created;
  result.tracks_removed = tracks.removed;
  result.tracks_merged = tracks.merged;
  result.tracks_refused = tracks.refused;
  return result;
}

}  // namespace geoloc::c
