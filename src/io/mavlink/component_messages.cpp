// SPDX-License-Identifier: Apache-2.0
#include "component_messages.hpp"

#include <all/mavlink.h>

#include <cmath>
#include <optional>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "message_values.hpp"
#include "unpack.hpp"

namespace geoloc::io {
namespace {

/// What the yaw counts from, of two flags or, where neither or both are set, by whether it is locked to north
/// (the specification of GIMBAL_DEVICE_FLAGS_YAW_LOCK).
GimbalYaw yaw_origin(std::uint16_t flags) {
  const bool is_from_nose = (flags & GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME) != 0;
  const bool is_from_north = (flags & GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME) != 0;
  if (is_from_nose != is_from_north) return is_from_north ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
  return (flags & GIMBAL_DEVICE_FLAGS_YAW_LOCK) != 0 ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
}

/// Angles in degrees; a turn more or less is the same.
Message gimbal_message(GimbalMessage message, double roll_deg, double pitch_deg, double yaw_deg) {
  constexpr double kMost_deg = 360.01;
  for (const double angle_deg : {roll_deg, pitch_deg, yaw_deg}) {
    if (!(std::abs(angle_deg) <= kMost_deg)) return RefusedValues{};
  }
  message.sample.level_from_gimbal =
      ned_from_body({roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg});
  return message;
}

/// nullopt where it is not known, which senders tell by NaN or by 0.
std::optional<double> angle_of_view_rad(double angle_deg) {
  if (!(angle_deg > 0.0 && angle_deg < 180.0)) return std::nullopt;
  return angle_deg * kRadPerDeg;
}

}  // namespace

Message decode_gimbal_device(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_gimbal_device_attitude_status_decode);
  GimbalMessage message;
  message.sample.time = boot_time(fields.time_boot_ms);
  message.sample.level_from_gimbal = Eigen::Quaterniond(fields.q[0], fields.q[1], fields.q[2], fields.q[3]);
  if (!is_unit(message.sample.level_from_gimbal)) return RefusedValues{};
  message.sample.level_from_gimbal.normalize();
  message.sample.yaw = yaw_origin(fields.flags);
  message.sample.holds_direction = (fields.flags & GIMBAL_DEVICE_FLAGS_YAW_LOCK) != 0;
  message.source = GimbalSource::kDeviceStatus;
  message.has_time = true;
  message.device_id = fields.gimbal_device_id;
  message.failure_flags = fields.failure_flags;
  return message;
}

/// Its yaw from north is used where the one from the nose is not known.
Message decode_mount_orientation(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_mount_orientation_decode);
  const bool is_from_nose = std::isfinite(fields.yaw);
  GimbalMessage message;
  message.sample.time = boot_time(fields.time_boot_ms);
  message.sample.yaw = is_from_nose ? GimbalYaw::kFromNose : GimbalYaw::kFromNorth;
  message.source = GimbalSource::kMountOrientation;
  message.has_time = true;
  return gimbal_message(message, fields.roll, fields.pitch, is_from_nose ? fields.yaw : fields.yaw_absolute);
}

Message decode_mount_status(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_mount_status_decode);
  constexpr double kUnitsPerDegree = 100.0;
  return gimbal_message({}, fields.pointing_b / kUnitsPerDegree, fields.pointing_a / kUnitsPerDegree,
                        fields.pointing_c / kUnitsPerDegree);
}

Message decode_field_of_view(const Frame& frame) {
  const auto fields = unpack(frame, mavlink_msg_camera_fov_status_decode);
  FieldOfViewMessage message;
  message.sample.time = boot_time(fields.time_boot_ms);
  message.sample.horizontal_rad = angle_of_view_rad(fields.hfov);
  message.sample.vertical_rad = angle_of_view_rad(fields.vfov);
  message.device_id = fields.camera_device_id;
  if (!message.sample.horizontal_rad && !message.sample.vertical_rad) return NotDecoded{};
  return message;
}

Message decode_camera_settings(const Frame& frame) {
  const double percent = unpack(frame, mavlink_msg_camera_settings_decode).zoomLevel;
  if (!(percent >= 0.0 && percent <= 100.0)) return NotDecoded{};
  return ZoomLevel{percent};
}

}  // namespace geoloc::io
