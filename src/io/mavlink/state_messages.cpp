// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/state_messages.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

#include "geoloc/geometry/angles.hpp"
#include "pack.hpp"

namespace geoloc::io {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

MavAddress autopilot_of(std::uint8_t system) {
  return {system, MAV_COMP_ID_AUTOPILOT1};
}

std::uint32_t milliseconds(VehicleTime time) {
  return static_cast<std::uint32_t>(
      std::chrono::round<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

/// In the message's integer, at its ends where it is beyond them.
template <typename Integer>
Integer scaled(double value, double scale) {
  constexpr double kLeast = std::numeric_limits<Integer>::min(), kMost = std::numeric_limits<Integer>::max();
  return static_cast<Integer>(std::llround(std::clamp(value * scale, kLeast, kMost)));
}

std::uint32_t millimetres(const std::optional<double>& sigma_m) {
  return sigma_m ? std::max<std::uint32_t>(1, scaled<std::uint32_t>(*sigma_m, 1e3)) : 0;
}

}  // namespace

OutgoingFrame StateWriter::heartbeat() {
  mavlink_heartbeat_t fields{};
  fields.type = MAV_TYPE_QUADROTOR;
  fields.autopilot = MAV_AUTOPILOT_GENERIC;
  fields.system_status = MAV_STATE_ACTIVE;
  fields.mavlink_version = 3;
  return pack(autopilot_of(system_), sequence_++, true, mavlink_msg_heartbeat_encode_status, fields);
}

OutgoingFrame StateWriter::attitude(const AttitudeSample& sample) {
  const Eigen::Vector3d rates =
      sample.rates_in_body_radps.value_or(Eigen::Vector3d::Constant(static_cast<double>(kNoNumber)));
  mavlink_attitude_t fields{};
  fields.time_boot_ms = milliseconds(sample.time);
  fields.roll = static_cast<float>(sample.angles.roll_rad);
  fields.pitch = static_cast<float>(sample.angles.pitch_rad);
  fields.yaw = static_cast<float>(sample.angles.yaw_rad);
  fields.rollspeed = static_cast<float>(rates.x());
  fields.pitchspeed = static_cast<float>(rates.y());
  fields.yawspeed = static_cast<float>(rates.z());
  return pack(autopilot_of(system_), sequence_++, true, mavlink_msg_attitude_encode_status, fields);
}

OutgoingFrame StateWriter::position(const PositionSample& sample) {
  const Eigen::Vector3d velocity = sample.velocity_in_enu.value_or(Eigen::Vector3d::Zero());
  mavlink_global_position_int_t fields{};
  fields.time_boot_ms = milliseconds(sample.time);
  fields.lat = scaled<std::int32_t>(sample.position.latitude_deg, 1e7);
  fields.lon = scaled<std::int32_t>(sample.position.longitude_deg, 1e7);
  fields.alt = scaled<std::int32_t>(sample.height_msl_m.value_or(sample.height_above_home_m), 1e3);
  fields.relative_alt = scaled<std::int32_t>(sample.height_above_home_m, 1e3);
  fields.vx = scaled<std::int16_t>(velocity.y(), 1e2);
  fields.vy = scaled<std::int16_t>(velocity.x(), 1e2);
  fields.vz = scaled<std::int16_t>(-velocity.z(), 1e2);
  fields.hdg = std::numeric_limits<std::uint16_t>::max();  // not told
  return pack(autopilot_of(system_), sequence_++, true, mavlink_msg_global_position_int_encode_status,
              fields);
}

OutgoingFrame StateWriter::gnss(const PositionSample& sample, const GnssClaim& claim) {
  constexpr auto kNotTold = std::numeric_limits<std::uint16_t>::max();
  mavlink_gps_raw_int_t fields{};
  fields.time_usec = std::uint64_t{milliseconds(sample.time)} * 1000;
  fields.fix_type = claim.fix_type;
  fields.lat = scaled<std::int32_t>(sample.position.latitude_deg, 1e7);
  fields.lon = scaled<std::int32_t>(sample.position.longitude_deg, 1e7);
  fields.alt = scaled<std::int32_t>(sample.height_msl_m.value_or(sample.height_above_home_m), 1e3);
  fields.eph = fields.epv = fields.vel = fields.cog = kNotTold;
  fields.satellites_visible = std::numeric_limits<std::uint8_t>::max();  // not told
  fields.h_acc = millimetres(claim.sigma_horizontal_m);
  fields.v_acc = millimetres(claim.sigma_height_m);
  return pack(autopilot_of(system_), sequence_++, true, mavlink_msg_gps_raw_int_encode_status, fields);
}

OutgoingFrame StateWriter::gimbal(const GimbalSample& sample) {
  return sample.holds_direction ? gimbal_device(sample, *sample.holds_direction) : mount_orientation(sample);
}

OutgoingFrame StateWriter::field_of_view(const FieldOfViewSample& sample) {
  constexpr auto kNowhere = std::numeric_limits<std::int32_t>::max();
  const auto degrees = [](const std::optional<double>& angle_rad) {
    return angle_rad ? static_cast<float>(*angle_rad * kDegPerRad) : kNoNumber;
  };
  mavlink_camera_fov_status_t fields{};
  fields.time_boot_ms = milliseconds(sample.time);
  fields.lat_camera = fields.lon_camera = fields.alt_camera = kNowhere;
  fields.lat_image = fields.lon_image = fields.alt_image = kNowhere;
  std::fill(std::begin(fields.q), std::end(fields.q), kNoNumber);
  fields.hfov = degrees(sample.horizontal_rad);
  fields.vfov = degrees(sample.vertical_rad);
  return pack({system_, MAV_COMP_ID_CAMERA}, camera_sequence_++, true,
              mavlink_msg_camera_fov_status_encode_status, fields);
}

OutgoingFrame StateWriter::gimbal_device(const GimbalSample& sample, bool holds_direction) {
  const Eigen::Quaterniond& turn = sample.level_from_gimbal;
  const std::array<double, 4> wxyz{turn.w(), turn.x(), turn.y(), turn.z()};
  mavlink_gimbal_device_attitude_status_t fields{};
  fields.time_boot_ms = milliseconds(sample.time);
  std::transform(wxyz.begin(), wxyz.end(), fields.q, [](double value) { return static_cast<float>(value); });
  fields.angular_velocity_x = fields.angular_velocity_y = fields.angular_velocity_z = kNoNumber;
  fields.delta_yaw = fields.delta_yaw_velocity = kNoNumber;
  fields.flags = GIMBAL_DEVICE_FLAGS_ROLL_LOCK | GIMBAL_DEVICE_FLAGS_PITCH_LOCK;
  fields.flags |= sample.yaw == GimbalYaw::kFromNorth ? GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME
                                                      : GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME;
  if (holds_direction) fields.flags |= GIMBAL_DEVICE_FLAGS_YAW_LOCK;
  fields.gimbal_device_id = 1;
  return pack(autopilot_of(system_), sequence_++, true,
              mavlink_msg_gimbal_device_attitude_status_encode_status, fields);
}

OutgoingFrame StateWriter::mount_orientation(const GimbalSample& sample) {
  const EulerAngles angles = euler_angles(sample.level_from_gimbal);
  const auto yaw_deg = static_cast<float>(angles.yaw_rad * kDegPerRad);
  const bool is_from_north = sample.yaw == GimbalYaw::kFromNorth;
  mavlink_mount_orientation_t fields{};
  fields.time_boot_ms = milliseconds(sample.time);
  fields.roll = static_cast<float>(angles.roll_rad * kDegPerRad);
  fields.pitch = static_cast<float>(angles.pitch_rad * kDegPerRad);
  fields.yaw = is_from_north ? kNoNumber : yaw_deg;
  fields.yaw_absolute = is_from_north ? yaw_deg : kNoNumber;
  return pack(autopilot_of(system_), sequence_++, true, mavlink_msg_mount_orientation_encode_status, fields);
}

}  // namespace geoloc::io
