// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/camera_telemetry.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::sim {
namespace {

/// The first of the messages that the flight has.
std::optional<RecordedStream> stream_of(std::vector<RecordedStream>& streams,
                                        std::initializer_list<std::uint32_t> message_ids) {
  for (const std::uint32_t id : message_ids) {
    const auto found = std::find_if(streams.begin(), streams.end(),
                                    [id](const auto& stream) { return stream.message_id == id; });
    if (found != streams.end()) return std::move(*found);
  }
  return std::nullopt;
}

io::Message decoded(const FrameView& view) {
  io::Frame frame;
  frame.message_id = view.message_id;
  frame.payload = view.payload;
  frame.payload_size = view.payload_size;
  return io::decode(frame);
}

/// The last message of that kind, and when it was sent on the flight's clock.
template <typename Content>
std::optional<std::pair<Content, VehicleTime>> latest(const std::optional<RecordedStream>& stream,
                                                      VehicleTime time) {
  if (!stream) return std::nullopt;
  const RecordedMessage& message = stream->messages[stream->latest(time)];
  const io::Message content = decoded(message.frame);
  const auto* const found = std::get_if<Content>(&content);
  if (found == nullptr || message.sent_at > time) return std::nullopt;
  return std::pair{*found, message.sent_at};
}

EulerAngles from_nose(const GimbalSample& gimbal, double vehicle_yaw_rad) {
  const double turn_rad = gimbal.yaw == GimbalYaw::kFromNorth ? -vehicle_yaw_rad : 0.0;
  const Eigen::AngleAxisd to_nose(turn_rad, Eigen::Vector3d::UnitZ());
  return euler_angles((to_nose * gimbal.level_from_gimbal).normalized());
}

}  // namespace

CameraTelemetry::CameraTelemetry(const Flight& flight, const FlightClock& clock,
                                 const CameraIntrinsics& camera)
    : flight_(flight), clock_(clock), half_width_(0.5 * camera.width_px / camera.fx_px) {
  std::vector<RecordedStream> streams = recorded_streams(flight);
  attitudes_ = stream_of(streams, {MAVLINK_MSG_ID_ATTITUDE});
  positions_ = stream_of(streams, {MAVLINK_MSG_ID_GLOBAL_POSITION_INT});
  gimbal_ = stream_of(streams, {MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS,
                                MAVLINK_MSG_ID_MOUNT_ORIENTATION, MAVLINK_MSG_ID_MOUNT_STATUS});
}

io::VideoTelemetry CameraTelemetry::at(HostTime stamp) const {
  const VehicleTime now = clock_.flight_time(stamp);
  const double speed = clock_.is_flying(stamp) ? clock_.speed() : 0.0;
  const auto age = [&](VehicleTime told) {
    return speed > 0.0 && now > told ? from_seconds(seconds(now - told) / speed) : Duration{};
  };
  io::VideoTelemetry telemetry;
  telemetry.made_at = io::CameraTime{stamp.time_since_epoch()};
  telemetry.zoom = flight_.zoom_at(now);
  telemetry.horizontal_fov_deg = 2.0 * std::atan(half_width_ / *telemetry.zoom) * kDegPerRad;
  double yaw_rad = 0.0;
  if (const auto told = latest<io::AttitudeMessage>(attitudes_, now)) {
    const AttitudeSample& sample = told->first.sample;
    yaw_rad = sample.angles.yaw_rad;
    telemetry.vehicle = {sample.angles, age(sample.time)};
  }
  if (const auto told = latest<PositionSample>(positions_, now)) {
    const PositionSample& sample = told->first;
    telemetry.position = {sample.position, *sample.height_msl_m, sample.height_above_home_m,
                          age(sample.time)};
    telemetry.velocity = {*sample.velocity_in_enu * speed, age(sample.time)};
  }
  if (const auto told = latest<io::GimbalMessage>(gimbal_, now)) {
    const VehicleTime time = told->first.has_time ? told->first.sample.time : told->second;
    telemetry.gimbal = {from_nose(told->first.sample, yaw_rad), age(time)};
  }
  return telemetry;
}

}  // namespace geoloc::sim
