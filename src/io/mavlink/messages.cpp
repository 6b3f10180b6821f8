// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/messages.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "component_messages.hpp"
#include "geoloc/geometry/angles.hpp"
#include "message_values.hpp"
#include "unpack.hpp"

namespace geoloc::io {
namespace {

constexpr double kLargestTurn_rad = 6.2832;  // for angles that may be given as 0..2 pi
constexpr double kLargestPitch_rad = 1.5709;
constexpr double kLargestHeight_m = 100e3;

Message decode_heartbeat(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_heartbeat_decode);
  return Heartbeat{fields.type, fields.autopilot};
}

/// `fields` tell the rates about the body's axes in the same names in both messages.
template <typename Fields>
Message attitude_message(const Fields& fields, const EulerAngles& angles, bool from_quaternion) {
  const bool is_valid = std::abs(angles.roll_rad) <= kLargestTurn_rad &&
                        std::abs(angles.pitch_rad) <= kLargestPitch_rad &&
                        std::abs(angles.yaw_rad) <= kLargestTurn_rad;
  if (!is_valid) return RefusedValues{};
  const Eigen::Vector3d rates_in_body_radps(fields.rollspeed, fields.pitchspeed, fields.yawspeed);
  return AttitudeMessage{{boot_time(fields.time_boot_ms), angles, rates_in_body_radps}, from_quaternion};
}

Message decode_attitude(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_attitude_decode);
  return attitude_message(fields, {fields.roll, fields.pitch, fields.yaw}, false);
}

Message decode_attitude_quaternion(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_attitude_quaternion_decode);
  const Eigen::Quaterniond ned_from_body(fields.q1, fields.q2, fields.q3, fields.q4);
  if (!is_unit(ned_from_body)) return RefusedValues{};
  return attitude_message(fields, euler_angles(ned_from_body.normalized()), true);
}

Message decode_position(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_global_position_int_decode);
  PositionSample sample;
  sample.time = boot_time(fields.time_boot_ms);
  sample.position = {fields.lat / 1e7, fields.lon / 1e7};
  sample.height_above_home_m = fields.relative_alt / 1e3;
  sample.height_msl_m = fields.alt / 1e3;
  sample.velocity_in_enu = Eigen::Vector3d(fields.vy, fields.vx, -fields.vz) / 1e2;
  const bool is_valid = std::abs(sample.position.latitude_deg) <= 90.0 &&
                        std::abs(sample.position.longitude_deg) <= 180.0 &&
                        std::abs(sample.height_above_home_m) <= kLargestHeight_m &&
                        std::abs(*sample.height_msl_m) <= kLargestHeight_m;
  if (!is_valid) return RefusedValues{};
  return sample;
}

/// Sensors report what is out of their range at its ends, or beyond.
Message decode_distance_sensor(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_distance_sensor_decode);
  constexpr std::uint8_t kInvalidSignal = 1;  // 0: not stated
  const bool is_measured = fields.current_distance > fields.min_distance &&
                           fields.current_distance < fields.max_distance &&
                           fields.signal_quality != kInvalidSignal;
  if (fields.orientation != MAV_SENSOR_ROTATION_PITCH_270 || !is_measured) return NotDecoded{};
  return RangeMessage{boot_time(fields.time_boot_ms), fields.current_distance / 1e2};
}

Message decode_rangefinder(const Frame& frame) {
  const double distance_m = unpack(frame, mavlink_msg_rangefinder_decode).distance;
  if (!(std::abs(distance_m) <= kLargestHeight_m)) return RefusedValues{};
  if (!(distance_m > 0.0)) return NotDecoded{};  // out of range
  return RangeMessage{std::nullopt, distance_m};
}

Message decode_gnss_status(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_gps_raw_int_decode);
  GnssStatus status;
  status.fix_type = fields.fix_type;
  const bool states_accuracy = fields.h_acc != 0 && fields.h_acc != std::numeric_limits<std::uint32_t>::max();
  if (states_accuracy) status.sigma_horizontal_m = fields.h_acc / 1e3;
  return status;
}

Message decode_ekf_status(const Frame& frame) {
  const std::uint16_t flags = unpack(frame, mavlink_msg_ekf_status_report_decode).flags;
  return EstimatorStatus{flags, (flags & EKF_GPS_GLITCHING) != 0, std::nullopt};
}

Message decode_estimator_status(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_estimator_status_decode);
  EstimatorStatus status{fields.flags, (fields.flags & ESTIMATOR_GPS_GLITCH) != 0, std::nullopt};
  const double accuracy_m = fields.pos_horiz_accuracy;
  // Without an absolute position it is one against the place where the filter began.
  if (status.has_absolute_position() && accuracy_m > 0.0 && std::isfinite(accuracy_m))
    status.sigma_horizontal_m = accuracy_m;
  return status;
}

Message decode_timesync(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_timesync_decode);
  Timesync timesync{fields.tc1, fields.ts1, {}};
  // An extension of dialects newer than the generated one, recognised by the length alone.
  constexpr std::size_t kTargetSystem = 16, kTargetComponent = 17;
  if (frame.payload_size > kTargetSystem) timesync.target.system = frame.payload[kTargetSystem];
  if (frame.payload_size > kTargetComponent) timesync.target.component = frame.payload[kTargetComponent];
  return timesync;
}

Message decode_system_time(const Frame& frame) {
  return SystemTime{boot_time(unpack(frame, mavlink_msg_system_time_decode).time_boot_ms)};
}

Message decode_command_ack(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_command_ack_decode);
  return CommandAck{fields.command, fields.result, {fields.target_system, fields.target_component}};
}

}  // namespace

bool Heartbeat::is_from_autopilot() const {
  return autopilot != MAV_AUTOPILOT_INVALID && vehicle_type != MAV_TYPE_GCS;
}

bool Heartbeat::is_from_ardupilot() const {
  return autopilot == MAV_AUTOPILOT_ARDUPILOTMEGA;
}

bool Heartbeat::is_from_camera() const {
  return vehicle_type == MAV_TYPE_CAMERA;
}

bool Heartbeat::is_from_px4() const {
  return autopilot == MAV_AUTOPILOT_PX4;
}

bool EstimatorStatus::has_absolute_position() const {
  static_assert(static_cast<int>(EKF_POS_HORIZ_ABS) == static_cast<int>(ESTIMATOR_POS_HORIZ_ABS));
  return (flags & EKF_POS_HORIZ_ABS) != 0;
}

Message decode(const Frame& frame) {
  switch (frame.message_id) {
    case MAVLINK_MSG_ID_HEARTBEAT:
      return decode_heartbeat(frame);
    case MAVLINK_MSG_ID_ATTITUDE:
      return decode_attitude(frame);
    case MAVLINK_MSG_ID_ATTITUDE_QUATERNION:
      return decode_attitude_quaternion(frame);
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
      return decode_position(frame);
    case MAVLINK_MSG_ID_DISTANCE_SENSOR:
      return decode_distance_sensor(frame);
    case MAVLINK_MSG_ID_RANGEFINDER:
      return decode_rangefinder(frame);
    case MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS:
      return decode_gimbal_device(frame);
    case MAVLINK_MSG_ID_MOUNT_ORIENTATION:
      return decode_mount_orientation(frame);
    case MAVLINK_MSG_ID_MOUNT_STATUS:
      return decode_mount_status(frame);
    case MAVLINK_MSG_ID_CAMERA_FOV_STATUS:
      return decode_field_of_view(frame);
    case MAVLINK_MSG_ID_CAMERA_SETTINGS:
      return decode_camera_settings(frame);
    case MAVLINK_MSG_ID_GPS_RAW_INT:
      return decode_gnss_status(frame);
    case MAVLINK_MSG_ID_EKF_STATUS_REPORT:
      return decode_ekf_status(frame);
    case MAVLINK_MSG_ID_ESTIMATOR_STATUS:
      return decode_estimator_status(frame);
    case MAVLINK_MSG_ID_TIMESYNC:
      return decode_timesync(frame);
    case MAVLINK_MSG_ID_SYSTEM_TIME:
      return decode_system_time(frame);
    case MAVLINK_MSG_ID_COMMAND_ACK:
      return decode_command_ack(frame);
    default:
      return NotDecoded{};
  }
}

std::optional<Command> decode_command(const Frame& frame) {
  if (frame.message_id != MAVLINK_MSG_ID_COMMAND_LONG) return std::nullopt;
  const auto fields = unpack(frame, mavlink_msg_command_long_decode);
  return Command{fields.command,
                 {fields.target_system, fields.target_component},
                 {fields.param1, fields.param2, fields.param3, fields.param4, fields.param5, fields.param6,
                  fields.param7}};
}

}  // namespace geoloc::io
