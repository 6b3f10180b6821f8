// SPDX-License-Identifier: Apache-2.0
#include "pipeline/geolocator_implementation.hpp"

#include <algorithm>
#include <cmath>

#include "camera/camera_fields.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geometry/room.hpp"
#include "projection/frame_projector.hpp"
#include "tracking/joint_tracker.hpp"
#include "tracking/paper_tracker.hpp"

namespace geoloc {
namespace {

GeolocatorConfig checked(const GeolocatorConfig& config) {
  refuse_if_any(config.problems());
  return config;
}

std::unique_ptr<Tracker> make_tracker(const GeolocatorConfig& config) {
  if (config.method == Method::kPaper)
    return std::make_unique<PaperTracker>(config.paper, config.max_detections);
  return std::make_unique<JointTracker>(config.joint, config.known_points, config.max_detections);
}

std::size_t bytes_of_tracker(const GeolocatorConfig& config) {
  if (config.method == Method::kPaper)
    return sizeof(PaperTracker) + PaperTracker::take_room(nullptr, config.paper, config.max_detections);
  return sizeof(JointTracker) +
         JointTracker::take_room(nullptr, config.joint, config.known_points, config.max_detections);
}

FrameFate fate_of(NoState reason) {
  switch (reason) {
    case NoState::kNotYet:
      return FrameFate::kAfterTelemetry;
    case NoState::kTooOld:
      return FrameFate::kBeforeTelemetry;
    case NoState::kInAGap:
      return FrameFate::kInAGap;
    case NoState::kNoSamples:
      return FrameFate::kNoTelemetry;
    case NoState::kNoGimbal:
      return FrameFate::kNoGimbal;
  }
  return FrameFate::kNoTelemetry;
}

}  // namespace

Geolocator::Implementation::Implementation(const GeolocatorConfig& given)
    : config(checked(given)),
      state(config.state),
      viewer{state, config.camera.mount, config.camera_orientation},
      projector(config.projector, config.camera.intrinsics),
      ground(config.joint.sigma_ground_m),
      tracker(make_tracker(config)),
      waiting(config.max_detections),
      zoom_(config.camera.intrinsics),
      taken_(config.max_detections) {
  take_room(this, config);
}

/// Its parts have taken theirs.
std::size_t Geolocator::Implementation::take_room(Implementation* self, const GeolocatorConfig& config) {
  std::size_t bytes =
      room::bytes_of_copy(config.joint.moving.classes) + room::bytes_of_copy(config.known_points);
  for (const KnownPoint& point : config.known_points) bytes += room::bytes_of_copy(point.name);
  return bytes + bytes_of_tracker(config) + FrameQueue::take_room(nullptr, config.max_detections) +
         KeptFrame::take_room(nullptr, config.max_detections) +
         room::reserve(self, &Implementation::located, config.max_detections) +
         room::reserve(self, &Implementation::turned_located_, config.max_detections);
}

/// A reboot sets the vehicle's clock back.
void Geolocator::Implementation::add(const RangeSample& sample) {
  if (!(sample.distance_m > 0.0) || !std::isfinite(sample.distance_m)) return;
  if (const auto reboots = state.counters().reboots; reboots != reboots_) {
    ranges_.clear();
    reboots_ = reboots;
  }
  if (ranges_.insert(sample.time, sample.distance_m)) ++counters.ranges;
}

/// Cameras that are fixed to the body leave a gimbal alone.
void Geolocator::Implementation::add(const GimbalSample& sample) {
  if (config.camera.mount.kind != MountKind::kGimbal) return;
  const GimbalYaw reading = state.gimbal().reading(sample.yaw);
  const bool was_set_point = state.gimbal().is_set_point();
  state.add(sample);
  const bool turned_out_set_point = state.gimbal().is_set_point() && !was_set_point;
  if (turned_out_set_point || state.gimbal().reading(sample.yaw) != reading) begin_map_anew();
}

void Geolocator::Implementation::add(const FieldOfViewSample& sample) {
  if (const auto focal_px = zoom_.focal_px(sample)) state.add_focal_length(sample.time, *focal_px);
}

/// Nothing that was estimated holds, but for the local frame.
void Geolocator::Implementation::begin_map_anew() {
  if (!last_stamp_) return;
  ++counters.maps_void;
  tracker = make_tracker(config);
  located.clear();
  last_stamp_.reset();
  has_object_ = false;
}

std::optional<NoState> Geolocator::Implementation::missing_state(VehicleTime captured_at) const {
  const auto vehicle = state.at(believed_time(captured_at));
  if (!vehicle) return vehicle.error();
  if (!state.is_zoom_settled(vehicle->time)) return NoState::kNotYet;
  if (const auto zoom = state.zoom().at(vehicle->time); !zoom) return zoom.error();
  if (config.camera.mount.kind != MountKind::kGimbal) return std::nullopt;
  const auto gimbal = state.gimbal_at(*vehicle);
  if (!gimbal) return gimbal.error();
  return std::nullopt;
}

/// The distance between two readings that are near to each other in time and length: not across a wall's
/// edge, and not across a spike.
std::optional<double> Geolocator::Implementation::range_at(VehicleTime time) const {
  constexpr double kLongestGap_s = 0.5, kMostChange = 0.2;
  const auto bracket = ranges_.bracket(time, from_seconds(kLongestGap_s), Duration::zero());
  if (!bracket) return std::nullopt;
  const double nearer_m = std::min(bracket->before, bracket->after);
  if (!(std::abs(bracket->after - bracket->before) <= kMostChange * nearer_m)) return std::nullopt;
  return bracket->interpolated();
}

void Geolocator::Implementation::take(const FrameDetections& frame) {
  taken_.take(frame, config);
  taken_.clock_epoch = state.clock_epoch();
}

/// Where there is no room, the latest one goes: telemetry may never come to a time that is far ahead.
std::optional<FrameOutcome> Geolocator::Implementation::add(const FrameDetections& frame) {
  take(frame);
  std::optional<FrameOutcome> gone;
  if (waiting.is_full()) {
    const bool is_latest = !is_before(taken_, waiting.latest());
    gone = count(is_latest ? taken_.stamp : waiting.latest().stamp, FrameFate::kNoRoom);
    if (is_latest) return gone;
    waiting.remove_latest();
  }
  waiting.insert(taken_);
  return gone;
}

/// While telemetry is missing, the latest frames are given up one by one, so that their number is bounded and
/// their fate is told.
std::optional<FrameOutcome> Geolocator::Implementation::process_next(FrameWait wait) {
  if (waiting.size() == 0) return std::nullopt;
  const KeptFrame& next = waiting.earliest();
  if (wait == FrameWait::kNoLonger || !must_wait(next)) {
    const FrameOutcome outcome = count(next.stamp, process_waiting(next));
    waiting.remove_earliest();
    return outcome;
  }
  if (!waiting.is_full()) return std::nullopt;
  const FrameStamp stamp = waiting.latest().stamp;
  const auto missing = missing_state(stamp.captured_at);
  waiting.remove_latest();
  return count(stamp, missing ? fate_of(*missing) : FrameFate::kNoRoom);
}

bool Geolocator::Implementation::process(const FrameDetections& frame) {
  take(frame);
  return count(taken_.stamp, locate(taken_)).is_located();
}

void Geolocator::Implementation::finish() {
  while (process_next(FrameWait::kNoLonger)) {
  }
  if (last_stamp_) tracker->finish(located_frame(*last_stamp_, view, located));
}

bool Geolocator::Implementation::is_late(const KeptFrame& frame) const {
  return last_processed_ && std::make_pair(frame.clock_epoch, frame.stamp.captured_at) <= *last_processed_;
}

bool Geolocator::Implementation::must_wait(const KeptFrame& frame) const {
  return !is_forgotten(frame) && !is_late(frame) &&
         !viewer.is_settled(frame.stamp, believed_time(frame.stamp.captured_at));
}

FrameFate Geolocator::Implementation::process_waiting(const KeptFrame& frame) {
  if (is_forgotten(frame)) return FrameFate::kClockBegunAnew;
  if (is_late(frame)) return FrameFate::kOutOfOrder;
  return locate(frame);
}

FrameOutcome Geolocator::Implementation::count(const FrameStamp& stamp, FrameFate fate) {
  ++counters.frames;
  ++(fate == FrameFate::kLocated ? counters.frames_located : counters.frames_unusable);
  ++counters.frames_by_fate[static_cast<std::size_t>(fate)];
  return {stamp.captured_at, stamp.captured_at_host, fate};
}

FrameFate Geolocator::Implementation::locate(const KeptFrame& frame) {
  const FrameStamp& stamp = frame.stamp;
  if (stamp.mount && !is_usable(*stamp.mount)) return FrameFate::kUnusableMount;
  if (stamp.focal_px && !is_focal_length(*stamp.focal_px, config.camera.intrinsics))
    return FrameFate::kUnusableFocalLength;
  anchor_state(stamp.captured_at);
  const auto nominal_view = viewer.nominal_view(stamp, tracker->calibration().latency_s());
  if (!nominal_view) return fate_of(nominal_view.error());
  state.keep_frame();
  if (config.terrain && ground.is_level())
    ground = GroundModel(config.terrain, *state.local_frame(), config.joint.sigma_ground_m);
  view = lifted(*nominal_view);
  counters.detections += frame.detections.size();
  counters.detections_dropped += frame.dropped;
  counters.detections_at_edge += frame.at_edge;
  locate(frame.detections, view, located, counters.no_fix);
  if (may_be_turned(stamp)) {
    track_either_way(frame);
  } else {
    tracker->update(located_frame(stamp, view, located));
  }
  last_processed_.emplace(frame.clock_epoch, stamp.captured_at);
  return FrameFate::kLocated;
}

LocatedFrame Geolocator::Implementation::located_frame(
    const FrameStamp& stamp, const FrameView& from, const std::vector<LocatedDetection>& detections) const {
  return {detections, projector, from,   *state.local_frame(),
          stamp,      viewer,    ground, range_at(from.vehicle.time)};
}

/// As the vehicle tells its yaw, or 180 deg from it.
void Geolocator::Implementation::track_either_way(const KeptFrame& frame) {
  const FrameStamp& stamp = frame.stamp;
  FrameStamp turned_stamp = stamp;
  turned_stamp.is_turned = true;
  const auto nominal_view = viewer.nominal_view(turned_stamp, tracker->calibration().latency_s());
  const FrameView turned_view = nominal_view ? lifted(*nominal_view) : view;
  decltype(Counters::no_fix) unused{};
  locate(frame.detections, turned_view, turned_located_, unused);
  const LocatedFrame turned = located_frame(turned_stamp, turned_view, turned_located_);
  LocatedFrame stated = located_frame(stamp, view, located);
  stated.turned = &turned;
  const std::uint64_t before = tracker->counters().frames_turned;
  tracker->update(stated);
  if (tracker->counters().frames_turned == before) return;
  view = turned_view;
  located.swap(turned_located_);
}

/// Within a second no vehicle turns round unseen.
bool Geolocator::Implementation::may_be_turned(const FrameStamp& stamp) {
  constexpr Duration kUnseen = std::chrono::seconds{1};
  const auto before = std::exchange(last_stamp_, stamp);
  return config.method == Method::kJoint && before &&
         stamp.captured_at_host - before->captured_at_host >= kUnseen;
}

/// The joint method's rays meet a level plane at the height of the ground below the vehicle.
FrameView Geolocator::Implementation::lifted(FrameView nominal_view) const {
  const Eigen::Vector3d& camera = nominal_view.enu_from_camera.translation;
  if (config.method == Method::kJoint) nominal_view.terrain_m = ground.height_m(camera.head<2>());
  return calibrated(nominal_view, tracker->calibration(),
                    tracker->lift_m(reported_height_m(nominal_view, config.projector)));
}

/// Nothing is on the map until an object is confirmed: of the states before and after a step, the newest is
/// more often right. From then on the map must not jump.
void Geolocator::Implementation::anchor_state(VehicleTime captured_at) {
  const auto& tracks = tracker->tracks();
  has_object_ = has_object_ || std::any_of(tracks.begin(), tracks.end(), [](const Track& track) {
                  return track.status == TrackStatus::kConfirmed;
                });
  if (!has_object_) state.anchor(believed_time(captured_at));
}

void Geolocator::Implementation::locate(const std::vector<Detection>& detections, const FrameView& from,
                                        std::vector<LocatedDetection>& found,
                                        decltype(Counters::no_fix)& no_fix) const {
  found.clear();
  const auto take = [&](std::size_t i, const Expected<GroundFix, NoFix>& fix) {
    if (fix) {
      found.push_back({detections[i], *fix});
    } else {
      ++no_fix[static_cast<std::size_t>(fix.error())];
    }
  };
  const auto pixel_of = [&](std::size_t i) { return detections[i].box.centre(); };
  if (config.method == Method::kJoint || ground.is_level())
    return FrameProjector(projector, from).project(detections.size(), pixel_of, take);
  for (std::size_t i = 0; i < detections.size(); ++i) take(i, projector.project(pixel_of(i), from, ground));
}

}  // namespace geoloc
