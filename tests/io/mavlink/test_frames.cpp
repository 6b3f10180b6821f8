// SPDX-License-Identifier: Apache-2.0
#include "io/mavlink/test_frames.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace geoloc::io::testing {
namespace {

std::uint32_t boot_ms(VehicleTime time) {
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

Bytes to_bytes(const mavlink_message_t& message) {
  Bytes bytes(MAVLINK_MAX_PACKET_LEN);
  bytes.resize(mavlink_msg_to_send_buffer(bytes.data(), &message));
  return bytes;
}

mavlink_signing_t signing_by(const std::array<std::uint8_t, 32>& key) {
  mavlink_signing_t signing{};
  std::copy(key.begin(), key.end(), signing.secret_key);
  return signing;
}

}  // namespace

bool is_signed_by(const std::array<std::uint8_t, 32>& key, const Bytes& frame) {
  mavlink_signing_t signing = signing_by(key);
  mavlink_signing_streams_t streams{};
  mavlink_message_t buffer{}, message{};
  mavlink_status_t state{}, status{};
  state.signing = &signing;
  state.signing_streams = &streams;
  int complete = 0;
  for (const std::uint8_t byte : frame)
    complete +=
        mavlink_frame_char_buffer(&buffer, &state, byte, &message, &status) == MAVLINK_FRAMING_OK ? 1 : 0;
  return complete == 1 && (message.incompat_flags & MAVLINK_IFLAG_SIGNED) != 0;
}

template <typename Encode, typename Fields>
Bytes FrameFactory::pack(Encode encode, const Fields& fields) {
  mavlink_status_t status{};
  mavlink_signing_t signing{};
  if (signature_) {
    signing = signing_by(signature_->key);
    signing.flags = MAVLINK_SIGNING_FLAG_SIGN_OUTGOING;
    signing.link_id = signature_->link;
    signing.timestamp = signature_->stamp++;
    status.signing = &signing;
  }
  status.flags = use_v2_ ? 0 : MAVLINK_STATUS_FLAG_OUT_MAVLINK1;
  status.current_tx_seq = sequence_++;
  mavlink_message_t message{};
  encode(self_.system, self_.component, &status, &message, &fields);
  return to_bytes(message);
}

Bytes FrameFactory::heartbeat(std::uint8_t autopilot, std::uint8_t vehicle_type) {
  mavlink_heartbeat_t fields{};
  fields.autopilot = autopilot;
  fields.type = vehicle_type;
  fields.mavlink_version = 3;
  return pack(mavlink_msg_heartbeat_encode_status, fields);
}

Bytes FrameFactory::attitude(VehicleTime time, double roll_rad, double pitch_rad, double yaw_rad) {
  mavlink_attitude_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.roll = static_cast<float>(roll_rad);
  fields.pitch = static_cast<float>(pitch_rad);
  fields.yaw = static_cast<float>(yaw_rad);
  return pack(mavlink_msg_attitude_encode_status, fields);
}

Bytes FrameFactory::attitude_quaternion(VehicleTime time) {
  mavlink_attitude_quaternion_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.q1 = 1.0F;
  return pack(mavlink_msg_attitude_quaternion_encode_status, fields);
}

Bytes FrameFactory::position(VehicleTime time, double latitude_deg, double longitude_deg,
                             double height_above_home_m) {
  mavlink_global_position_int_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.lat = static_cast<std::int32_t>(std::lround(latitude_deg * 1e7));
  fields.lon = static_cast<std::int32_t>(std::lround(longitude_deg * 1e7));
  fields.relative_alt = static_cast<std::int32_t>(std::lround(height_above_home_m * 1e3));
  return pack(mavlink_msg_global_position_int_encode_status, fields);
}

Bytes FrameFactory::gnss(std::uint8_t fix_type, double h_acc_m) {
  mavlink_gps_raw_int_t fields{};
  fields.fix_type = fix_type;
  fields.h_acc = static_cast<std::uint32_t>(std::lround(h_acc_m * 1e3));
  return pack(mavlink_msg_gps_raw_int_encode_status, fields);
}

Bytes FrameFactory::distance_sensor(VehicleTime time, double distance_m, std::uint8_t orientation,
                                    std::uint8_t signal_quality) {
  mavlink_distance_sensor_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.min_distance = 20;
  fields.max_distance = 4000;
  fields.current_distance = static_cast<std::uint16_t>(std::lround(distance_m * 1e2));
  fields.orientation = orientation;
  fields.signal_quality = signal_quality;
  return pack(mavlink_msg_distance_sensor_encode_status, fields);
}

Bytes FrameFactory::rangefinder(double distance_m) {
  mavlink_rangefinder_t fields{};
  fields.distance = static_cast<float>(distance_m);
  return pack(mavlink_msg_rangefinder_encode_status, fields);
}

Bytes FrameFactory::gimbal_device(VehicleTime time, double pitch_rad, std::uint16_t flags,
                                  std::uint8_t device_id, std::uint32_t failure_flags) {
  mavlink_gimbal_device_attitude_status_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.q[0] = static_cast<float>(std::cos(0.5 * pitch_rad));
  fields.q[2] = static_cast<float>(std::sin(0.5 * pitch_rad));
  fields.flags = flags;
  fields.gimbal_device_id = device_id;
  fields.failure_flags = failure_flags;
  return pack(mavlink_msg_gimbal_device_attitude_status_encode_status, fields);
}

Bytes FrameFactory::mount_orientation(VehicleTime time, double pitch_deg) {
  mavlink_mount_orientation_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.pitch = static_cast<float>(pitch_deg);
  return pack(mavlink_msg_mount_orientation_encode_status, fields);
}

Bytes FrameFactory::mount_status(double pitch_deg) {
  mavlink_mount_status_t fields{};
  fields.pointing_a = static_cast<std::int32_t>(std::lround(100.0 * pitch_deg));
  return pack(mavlink_msg_mount_status_encode_status, fields);
}

Bytes FrameFactory::field_of_view(VehicleTime time, float horizontal_deg, float vertical_deg,
                                  std::uint8_t device_id) {
  mavlink_camera_fov_status_t fields{};
  fields.time_boot_ms = boot_ms(time);
  fields.hfov = horizontal_deg;
  fields.vfov = vertical_deg;
  fields.camera_device_id = device_id;
  return pack(mavlink_msg_camera_fov_status_encode_status, fields);
}

Bytes FrameFactory::zoom_level(float percent) {
  mavlink_camera_settings_t fields{};
  fields.zoomLevel = percent;
  fields.focusLevel = NAN;
  return pack(mavlink_msg_camera_settings_encode_status, fields);
}

Bytes FrameFactory::ekf_status(std::uint16_t flags) {
  mavlink_ekf_status_report_t fields{};
  fields.flags = flags;
  return pack(mavlink_msg_ekf_status_report_encode_status, fields);
}

Bytes FrameFactory::estimator_status(std::uint16_t flags, float pos_horiz_accuracy_m) {
  mavlink_estimator_status_t fields{};
  fields.pos_horiz_accuracy = pos_horiz_accuracy_m;
  fields.flags = flags;
  return pack(mavlink_msg_estimator_status_encode_status, fields);
}

Bytes FrameFactory::system_time(VehicleTime time) {
  mavlink_system_time_t fields{};
  fields.time_boot_ms = boot_ms(time);
  return pack(mavlink_msg_system_time_encode_status, fields);
}

Bytes FrameFactory::timesync(std::int64_t tc1, std::int64_t ts1) {
  return pack(mavlink_msg_timesync_encode_status, mavlink_timesync_t{tc1, ts1});
}

Bytes FrameFactory::timesync_to(MavAddress target, std::int64_t tc1, std::int64_t ts1) {
  constexpr std::uint8_t kSize = MAVLINK_MSG_ID_TIMESYNC_LEN + 2;
  const mavlink_timesync_t fields{tc1, ts1};
  mavlink_message_t message{};
  message.msgid = MAVLINK_MSG_ID_TIMESYNC;
  auto* const payload = reinterpret_cast<std::uint8_t*>(message.payload64);
  std::memcpy(payload, &fields, MAVLINK_MSG_ID_TIMESYNC_LEN);
  payload[kSize - 2] = target.system;
  payload[kSize - 1] = target.component;
  mavlink_status_t status{};
  status.current_tx_seq = sequence_++;
  mavlink_finalize_message_buffer(&message, self_.system, self_.component, &status, kSize, kSize,
                                  MAVLINK_MSG_ID_TIMESYNC_CRC);
  return to_bytes(message);
}

Bytes FrameFactory::command_ack(std::uint16_t command, std::uint8_t result, MavAddress target) {
  mavlink_command_ack_t fields{};
  fields.command = command;
  fields.result = result;
  fields.target_system = target.system;
  fields.target_component = target.component;
  return pack(mavlink_msg_command_ack_encode_status, fields);
}

Bytes FrameFactory::command_long(std::uint16_t command, MavAddress target, float parameter1,
                                 float parameter2) {
  mavlink_command_long_t fields{};
  fields.command = command;
  fields.target_system = target.system;
  fields.target_component = target.component;
  fields.param1 = parameter1;
  fields.param2 = parameter2;
  return pack(mavlink_msg_command_long_encode_status, fields);
}

Bytes FrameFactory::unknown(std::uint8_t payload_size, std::uint8_t fill) {
  constexpr std::uint32_t kNoSuchMessage = 0xABCDEF;
  mavlink_message_t message{};
  message.msgid = kNoSuchMessage;
  std::fill_n(reinterpret_cast<std::uint8_t*>(message.payload64), payload_size, fill);
  mavlink_status_t status{};
  status.current_tx_seq = sequence_++;
  mavlink_finalize_message_buffer(&message, self_.system, self_.component, &status, payload_size,
                                  payload_size, 0);
  return to_bytes(message);
}

}  // namespace geoloc::io::testing
