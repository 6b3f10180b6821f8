// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/px4_flight.hpp"

#include <all/mavlink.h>

#include <chrono>

#include "sim/live/log_builder.hpp"

namespace geoloc::sim {
namespace {

/// PX4 numbers main modes in the third byte and those below them in the fourth: AUTO, MISSION.
constexpr std::uint32_t kAutoMission = 4U << 24U | 4U << 16U;

Payload heartbeat(const FrameView& recorded) {
  auto fields = fields_in<mavlink_heartbeat_t>(recorded);
  fields.autopilot = MAV_AUTOPILOT_PX4;
  fields.custom_mode = kAutoMission;
  return payload_with(fields);
}

/// Up to the tenth, the flags of both mean the same.
std::uint16_t estimator_flags(std::uint16_t ekf_flags) {
  constexpr unsigned kShared = 0x3FF, kGlitch = ESTIMATOR_GPS_GLITCH;
  const bool has_glitch = (ekf_flags & EKF_GPS_GLITCHING) != 0;
  return static_cast<std::uint16_t>((ekf_flags & kShared) | (has_glitch ? kGlitch : 0U));
}

Payload estimator_status(const FrameView& recorded, VehicleTime time, const mavlink_gps_raw_int_t& gnss) {
  constexpr float kMetresPerUnit = 1e-3F;
  const auto ekf = fields_in<mavlink_ekf_status_report_t>(recorded);
  mavlink_estimator_status_t fields{};
  fields.time_usec = static_cast<std::uint64_t>(
      std::chrono::floor<std::chrono::microseconds>(time.time_since_epoch()).count());
  fields.vel_ratio = ekf.velocity_variance;
  fields.pos_horiz_ratio = ekf.pos_horiz_variance;
  fields.pos_vert_ratio = ekf.pos_vert_variance;
  fields.mag_ratio = ekf.compass_variance;
  fields.hagl_ratio = ekf.terrain_alt_variance;
  fields.tas_ratio = ekf.airspeed_variance;
  fields.pos_horiz_accuracy = kMetresPerUnit * static_cast<float>(gnss.h_acc);
  fields.pos_vert_accuracy = kMetresPerUnit * static_cast<float>(gnss.v_acc);
  fields.flags = estimator_flags(ekf.flags);
  return payload_with(fields);
}

}  // namespace

Flight as_px4(const Flight& flight) {
  LogBuilder log;
  mavlink_gps_raw_int_t gnss{};
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame) continue;
    FrameView as_told = *frame;
    switch (frame->message_id) {
      case MAVLINK_MSG_ID_HEARTBEAT:
        log.add(record.received_at, *frame, heartbeat(*frame));
        break;
      case MAVLINK_MSG_ID_EKF_STATUS_REPORT:
        as_told.message_id = MAVLINK_MSG_ID_ESTIMATOR_STATUS;
        log.add(record.received_at, as_told,
                estimator_status(*frame, VehicleTime{record.received_at - flight.booted_at}, gnss));
        break;
      case MAVLINK_MSG_ID_STATUSTEXT:
        break;
      case MAVLINK_MSG_ID_GPS_RAW_INT:
        gnss = fields_in<mavlink_gps_raw_int_t>(*frame);
        log.add(record);
        break;
      default:
        log.add(record);
    }
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at, flight.gimbal};
}

}  // namespace geoloc::sim
