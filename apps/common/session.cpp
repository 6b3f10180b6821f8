// SPDX-License-Identifier: Apache-2.0
#include "common/session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geoloc::apps {

namespace {

/// 1-sigma of a frame's time where the clocks' map adds its doubt; 0 where nothing is stated and nothing in
/// doubt.
double time_sigma_s(const PendingFrame& frame, const io::VehicleClockMap& clock) {
  const double doubt_s = seconds(clock.doubt());
  return doubt_s > 0.0 ? std::hypot(frame.time_sigma_s, doubt_s) : frame.time_sigma_s;
}

/// So many of the vehicle's positions in a row tell that the map begins elsewhere.
constexpr std::uint64_t kFarPositions = 20;

bool has_object(const std::vector<Track>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(),
                     [](const Track& track) { return track.status == TrackStatus::kConfirmed; });
}

}  // namespace

Session::Session(const EstimationConfig& config, OnTelemetry on_telemetry)
    : max_frame_wait_(from_seconds(config.frames.max_wait_s)),
      link_(config.mavlink, config.geolocator.camera.mount.kind == MountKind::kGimbal),
      geolocator_(config.geolocator),
      on_telemetry_(std::move(on_telemetry)) {}

bool Session::add_telemetry(HostTime received_at, const std::uint8_t* data, std::size_t size) {
  return link_.consume(received_at, data, size, *this);
}

void Session::on_frame(HostTime received_at, const std::uint8_t* frame, std::size_t size) {
  note_telemetry(census_, received_at);
  if (on_telemetry_) on_telemetry_(received_at, frame, size);
}

/// The map may have been begun at a place where the vehicle is not. Nothing is lost where it is empty.
void Session::on_position(const PositionSample& sample) {
  take(sample);
  if (geolocator_.state().too_far_in_a_row() >= kFarPositions && !has_object(geolocator_.tracks()))
    begin_anew();
}

void Session::on_gimbal(const GimbalSample& sample) {
  geolocator_.add(sample);
  news_.note_gimbal(geolocator_, link_.gimbal_failures());
}

/// Nothing that was estimated holds.
void Session::begin_anew() {
  frames_without_vehicle_ += geolocator_.counters().frames;
  const GeolocatorConfig config = geolocator_.config();
  geolocator_ = Geolocator(config);
  history_.begin_anew();
}

void Session::on_clock_step(Duration) {
  geolocator_.on_vehicle_clock_step();
}

bool Session::is_decided(HostTime captured_at) const {
  if (link_.clock().is_before_step(captured_at)) return true;
  const auto vehicle_time = link_.clock().to_vehicle(captured_at);
  if (!vehicle_time) return false;
  const auto missing = geolocator_.missing_state(*vehicle_time);
  return missing != NoState::kNotYet && missing != NoState::kNoSamples && missing != NoState::kNoGimbal;
}

HostTime Session::gives_up_at(HostTime captured_at) const {
  const auto calibration = geolocator_.calibration();
  const Duration early = calibration ? from_seconds(std::max(0.0, -calibration->latency_s())) : Duration{};
  return captured_at + early + max_frame_wait_;
}

bool Session::process(const PendingFrame& frame) {
  note_frame(census_, frame.captured_at, frame.detections, geolocator_.config().camera.intrinsics);
  const auto vehicle_time = link_.clock().to_vehicle(frame.captured_at);
  if (!vehicle_time) {
    ++frames_without_vehicle_;
    ++census_.frames_without_vehicle;
    return false;
  }
  frame_.captured_at = *vehicle_time;
  frame_.captured_at_host = frame.captured_at;
  frame_.time_sigma_s = time_sigma_s(frame, link_.clock());
  frame_.mount = frame.mount;
  frame_.focal_px = frame.focal_px;
  frame_.detections = frame.detections;
  frame_looks_.expect(geolocator_);
  const std::uint64_t number = frames();
  if (!geolocator_.process(frame_)) {
    if (const auto reason = geolocator_.missing_state(*vehicle_time))
      ++census_.frames_without_state[static_cast<std::size_t>(*reason)];
    return false;
  }
  news_.note_frame(geolocator_);
  looks_ = frame_looks_.looks(geolocator_, frame.captured_at);
  history_.note(geolocator_, frame.captured_at, number, looks_);
  return true;
}

}  // namespace geoloc::apps
