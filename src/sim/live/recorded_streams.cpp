// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/recorded_streams.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "geoloc/io/mavlink/message_table.hpp"

namespace geoloc::sim {
namespace {

constexpr std::uint8_t kAutopilot = 1;  // MAV_COMP_ID_AUTOPILOT1

/// The autopilot's messages are played, and how far a camera of its own component has zoomed in.
bool is_played(const FrameView& frame) {
  const std::uint32_t message_id = frame.message_id;
  if (frame.component_id != kAutopilot)
    return frame.component_id == MAV_COMP_ID_CAMERA && message_id == MAVLINK_MSG_ID_CAMERA_FOV_STATUS;
  return message_id != MAVLINK_MSG_ID_COMMAND_ACK && message_id != MAVLINK_MSG_ID_STATUSTEXT &&
         message_id != MAVLINK_MSG_ID_TIMESYNC;
}

std::int16_t scaled(std::int16_t value, double factor) {
  constexpr double kLeast = std::numeric_limits<std::int16_t>::min(),
                   kMost = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::lround(std::clamp(value * factor, kLeast, kMost)));
}

float scaled(float value, double factor) {
  return static_cast<float>(value * factor);
}

/// A time that the message carried, moved to the clock of the retelling: as old as it was, in flown distance.
Duration moved(Duration recorded_time, const Retelling& how) {
  const Duration age = how.recorded_clock - recorded_time;
  const Duration new_age = how.speed > 0.0 ? from_seconds(seconds(age) / how.speed) : age;
  return std::max(how.boot_clock - new_age, Duration::zero());
}

std::uint32_t moved_ms(std::uint32_t time_boot_ms, const Retelling& how) {
  const Duration time = moved(std::chrono::milliseconds{time_boot_ms}, how);
  return static_cast<std::uint32_t>(std::chrono::floor<std::chrono::milliseconds>(time).count());
}

std::uint64_t moved_us(std::uint64_t time_us, const Retelling& how) {
  constexpr std::uint64_t kLongestFlight_us = 1'000'000'000'000;
  const Duration time = moved(std::chrono::microseconds{std::min(time_us, kLongestFlight_us)}, how);
  return static_cast<std::uint64_t>(std::chrono::floor<std::chrono::microseconds>(time).count());
}

void edit(mavlink_attitude_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  m.rollspeed = scaled(m.rollspeed, how.speed);
  m.pitchspeed = scaled(m.pitchspeed, how.speed);
  m.yawspeed = scaled(m.yawspeed, how.speed);
}

void edit(mavlink_attitude_quaternion_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  m.rollspeed = scaled(m.rollspeed, how.speed);
  m.pitchspeed = scaled(m.pitchspeed, how.speed);
  m.yawspeed = scaled(m.yawspeed, how.speed);
}

void edit(mavlink_local_position_ned_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  m.vx = scaled(m.vx, how.speed);
  m.vy = scaled(m.vy, how.speed);
  m.vz = scaled(m.vz, how.speed);
}

void edit(mavlink_global_position_int_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  m.vx = scaled(m.vx, how.speed);
  m.vy = scaled(m.vy, how.speed);
  m.vz = scaled(m.vz, how.speed);
}

void edit(mavlink_gps_raw_int_t& m, const Retelling& how) {
  constexpr std::uint16_t kUnknown = std::numeric_limits<std::uint16_t>::max();
  m.time_usec = moved_us(m.time_usec, how);
  if (m.vel == kUnknown) return;
  m.vel = static_cast<std::uint16_t>(std::min(std::round(m.vel * how.speed), kUnknown - 1.0));
}

void edit(mavlink_estimator_status_t& m, const Retelling& how) {
  m.time_usec = moved_us(m.time_usec, how);
}

void edit(mavlink_system_time_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  const auto utc = std::chrono::floor<std::chrono::microseconds>(how.utc.time_since_epoch());
  if (m.time_unix_usec != 0) m.time_unix_usec = static_cast<std::uint64_t>(utc.count());
}

void edit(mavlink_gimbal_device_attitude_status_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
  m.angular_velocity_x = scaled(m.angular_velocity_x, how.speed);
  m.angular_velocity_y = scaled(m.angular_velocity_y, how.speed);
  m.angular_velocity_z = scaled(m.angular_velocity_z, how.speed);
  m.delta_yaw_velocity = scaled(m.delta_yaw_velocity, how.speed);
}

void edit(mavlink_mount_orientation_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
}

void edit(mavlink_camera_fov_status_t& m, const Retelling& how) {
  m.time_boot_ms = moved_ms(m.time_boot_ms, how);
}

void edit(mavlink_home_position_t& m, const Retelling& how) {
  m.time_usec = moved_us(m.time_usec, how);
}

void edit(mavlink_gps_global_origin_t& m, const Retelling& how) {
  m.time_usec = moved_us(m.time_usec, how);
}

/// The generated structs have the layout of the wire (little-endian hosts; the generated code assumes it
/// too).
template <typename Fields>
void edit_as(Payload& payload, const Retelling& how) {
  Fields fields;
  static_assert(sizeof fields <= std::tuple_size_v<Payload>);
  std::memcpy(&fields, payload.data(), sizeof fields);
  edit(fields, how);
  std::memcpy(payload.data(), &fields, sizeof fields);
}

}  // namespace

std::size_t RecordedStream::latest(VehicleTime time) const {
  const auto is_later = [](VehicleTime t, const RecordedMessage& message) { return t < message.sent_at; };
  const auto after = std::upper_bound(messages.begin(), messages.end(), time, is_later);
  return after == messages.begin() ? 0 : static_cast<std::size_t>(after - messages.begin()) - 1;
}

std::vector<RecordedStream> recorded_streams(const Flight& flight) {
  std::map<std::uint32_t, RecordedStream> streams;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || !is_played(*frame)) continue;
    if (!io::message_spec(frame->message_id)) continue;  // could not be framed again
    streams[frame->message_id].messages.push_back(
        {VehicleTime{record.received_at - flight.booted_at}, *frame});
  }
  std::vector<RecordedStream> result;
  for (auto& [message_id, stream] : streams) {
    const auto is_earlier = [](const auto& a, const auto& b) { return a.sent_at < b.sent_at; };
    std::stable_sort(stream.messages.begin(), stream.messages.end(), is_earlier);  // stamps of real logs jump
    stream.message_id = message_id;
    stream.component_id = stream.messages.front().frame.component_id;
    const auto gaps = static_cast<Duration::rep>(stream.messages.size()) - 1;
    if (gaps > 0) stream.period = (stream.messages.back().sent_at - stream.messages.front().sent_at) / gaps;
    result.push_back(std::move(stream));
  }
  return result;
}

std::optional<std::uint8_t> data_stream_of(std::uint32_t message_id) {
  switch (message_id) {
    case MAVLINK_MSG_ID_GPS_RAW_INT:
      return MAV_DATA_STREAM_EXTENDED_STATUS;
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
    case MAVLINK_MSG_ID_LOCAL_POSITION_NED:
      return MAV_DATA_STREAM_POSITION;
    case MAVLINK_MSG_ID_ATTITUDE:
      return MAV_DATA_STREAM_EXTRA1;
    case MAVLINK_MSG_ID_SYSTEM_TIME:
    case MAVLINK_MSG_ID_EKF_STATUS_REPORT:
      return MAV_DATA_STREAM_EXTRA3;
    default:
      return std::nullopt;
  }
}

Payload whole_payload(const FrameView& frame) {
  Payload payload{};
  std::copy_n(frame.payload, std::min(frame.payload_size, payload.size()), payload.begin());
  return payload;
}

Payload retell(const FrameView& recorded, const Retelling& how) {
  Payload payload = whole_payload(recorded);
  switch (recorded.message_id) {
    case MAVLINK_MSG_ID_ATTITUDE:
      edit_as<mavlink_attitude_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_ATTITUDE_QUATERNION:
      edit_as<mavlink_attitude_quaternion_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_LOCAL_POSITION_NED:
      edit_as<mavlink_local_position_ned_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
      edit_as<mavlink_global_position_int_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_GPS_RAW_INT:
      edit_as<mavlink_gps_raw_int_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_ESTIMATOR_STATUS:
      edit_as<mavlink_estimator_status_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_SYSTEM_TIME:
      edit_as<mavlink_system_time_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS:
      edit_as<mavlink_gimbal_device_attitude_status_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_MOUNT_ORIENTATION:
      edit_as<mavlink_mount_orientation_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_CAMERA_FOV_STATUS:
      edit_as<mavlink_camera_fov_status_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_HOME_POSITION:
      edit_as<mavlink_home_position_t>(payload, how);
      break;
    case MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN:
      edit_as<mavlink_gps_global_origin_t>(payload, how);
      break;
    default:
      break;
  }
  return payload;
}

}  // namespace geoloc::sim
