// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/flight_variants.hpp"

#include <all/mavlink.h>

#include <cmath>
#include <map>
#include <optional>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "geoloc/sim/live/recorded_streams.hpp"
#include "geoloc/sim/random.hpp"
#include "sim/live/log_builder.hpp"

namespace geoloc::sim {
namespace {

std::optional<Payload> raised_payload(const FrameView& frame, double metres) {
  const auto metres_mm = static_cast<std::int32_t>(std::lround(metres * 1e3));
  switch (frame.message_id) {
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT: {
      auto fields = fields_in<mavlink_global_position_int_t>(frame);
      fields.alt += metres_mm;
      fields.relative_alt += metres_mm;
      return payload_with(fields);
    }
    case MAVLINK_MSG_ID_GPS_RAW_INT: {
      auto fields = fields_in<mavlink_gps_raw_int_t>(frame);
      fields.alt += metres_mm;
      return payload_with(fields);
    }
    case MAVLINK_MSG_ID_LOCAL_POSITION_NED: {
      auto fields = fields_in<mavlink_local_position_ned_t>(frame);
      fields.z -= static_cast<float>(metres);
      return payload_with(fields);
    }
    default:
      return std::nullopt;
  }
}

bool tells_state(std::uint32_t message_id) {
  return message_id == MAVLINK_MSG_ID_ATTITUDE || message_id == MAVLINK_MSG_ID_ATTITUDE_QUATERNION ||
         message_id == MAVLINK_MSG_ID_GLOBAL_POSITION_INT;
}

/// Keeps the messages nearest to each due time.
void thin_out(const RecordedStream& stream, Duration period, const Flight& flight, LogBuilder& log) {
  VehicleTime due = stream.messages.front().sent_at;
  for (const RecordedMessage& message : stream.messages) {
    if (message.sent_at + stream.period / 2 < due) continue;
    log.add(flight.host_time(message.sent_at), message.frame, whole_payload(message.frame));
    while (due <= message.sent_at + stream.period / 2) due += period;
  }
}

/// ATTITUDE and what it is interpolated by.
struct AttitudeTelling {
  using Fields = mavlink_attitude_t;

  static Fields between(const Fields& a, const Fields& b, double fraction,
                        const std::array<Rigid3d, 3>& truth) {
    const EulerAngles at_a = angles(truth[0]), at_b = angles(truth[1]), now = angles(truth[2]);
    const auto told = [fraction](double a_told, double a_true, double b_told, double b_true,
                                 double true_now) {
      const double error_a = wrap_to_pi(a_told - a_true), error_b = wrap_to_pi(b_told - b_true);
      return static_cast<float>(wrap_to_pi(true_now + error_a + fraction * wrap_to_pi(error_b - error_a)));
    };
    Fields fields = a;
    fields.roll = told(a.roll, at_a.roll_rad, b.roll, at_b.roll_rad, now.roll_rad);
    fields.pitch = told(a.pitch, at_a.pitch_rad, b.pitch, at_b.pitch_rad, now.pitch_rad);
    fields.yaw = told(a.yaw, at_a.yaw_rad, b.yaw, at_b.yaw_rad, now.yaw_rad);
    return fields;
  }

 private:
  /// Against the local frame's north: how that differs from the true one cancels in the errors.
  static EulerAngles angles(const Rigid3d& enu_from_body) {
    return euler_angles(enu_from_ned() * enu_from_body.rotation);
  }
};

/// GLOBAL_POSITION_INT and what it is interpolated by. Its whole units, 1e-7 deg and 1 mm, are kept.
struct PositionTelling {
  using Fields = mavlink_global_position_int_t;

  static Fields between(const Fields& a, const Fields& b, double fraction,
                        const std::array<Rigid3d, 3>& truth) {
    // The messages are joined by a straight line; what is added is how the true path
    // departs from its own chord.
    const Eigen::Vector3d chord =
        truth[0].translation + fraction * (truth[1].translation - truth[0].translation);
    const Eigen::Vector3d bulge = truth[2].translation - chord;
    constexpr double kUnitsPerDegree = 1e7, kMetresPerDegree = 111.32e3, kUnitsPerMetre = 1e3;
    const double east_scale = std::cos(a.lat / kUnitsPerDegree * kRadPerDeg);
    const auto told = [fraction](std::int32_t a_told, std::int32_t b_told, double extra) {
      return static_cast<std::int32_t>(std::lround(a_told + fraction * (b_told - a_told) + extra));
    };
    Fields fields = a;
    fields.lat = told(a.lat, b.lat, bulge.y() / kMetresPerDegree * kUnitsPerDegree);
    fields.lon = told(a.lon, b.lon, bulge.x() / (kMetresPerDegree * east_scale) * kUnitsPerDegree);
    fields.alt = told(a.alt, b.alt, bulge.z() * kUnitsPerMetre);
    fields.relative_alt = told(a.relative_alt, b.relative_alt, bulge.z() * kUnitsPerMetre);
    return fields;
  }
};

VehicleTime boot_time(std::uint32_t time_boot_ms) {
  return VehicleTime{std::chrono::milliseconds{time_boot_ms}};
}

/// Messages at `due` and each multiple of the period after it, between two recorded ones; none where the
/// truth is not known.
template <typename Telling>
void fill_up(const RecordedStream& stream, VehicleTime due, Duration period, const Flight& flight,
             LogBuilder& log) {
  for (std::size_t i = 1; i < stream.messages.size(); ++i) {
    const FrameView& frame = stream.messages[i - 1].frame;
    const auto a = fields_in<typename Telling::Fields>(frame);
    const auto b = fields_in<typename Telling::Fields>(stream.messages[i].frame);
    const VehicleTime begin = boot_time(a.time_boot_ms), end = boot_time(b.time_boot_ms);
    for (; due < end; due += period) {
      if (due < begin) continue;
      const VehicleTime stamp{std::chrono::floor<std::chrono::milliseconds>(due.time_since_epoch())};
      const auto true_a = flight.truth.pose(begin), true_b = flight.truth.pose(end),
                 true_now = flight.truth.pose(stamp);
      if (stamp < begin || !true_a || !true_b || !true_now) continue;
      const double fraction = seconds(stamp - begin) / seconds(end - begin);
      auto fields = Telling::between(a, b, fraction, {*true_a, *true_b, *true_now});
      fields.time_boot_ms = static_cast<std::uint32_t>(
          std::chrono::duration_cast<std::chrono::milliseconds>(stamp.time_since_epoch()).count());
      log.add(flight.host_time(due), frame, payload_with(fields));
    }
  }
}

/// The stamp of the stream's first message, on the vehicle's clock. All messages that tell the state begin
/// alike.
VehicleTime first_stamp(const RecordedStream& stream) {
  return boot_time(load_u32(whole_payload(stream.messages.front().frame).data()));
}

}  // namespace

Flight raised(const Flight& flight, double metres) {
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    const auto payload = frame ? raised_payload(*frame, metres) : std::nullopt;
    if (payload) {
      log.add(record.received_at, *frame, *payload);
    } else {
      log.add(record);
    }
  }
  return {flight.name, log.build(), flight.truth.raised(metres), flight.booted_at};
}

Flight with_attitude_noise(const Flight& flight, const AttitudeNoise& noise) {
  Random random(noise.seed);
  Eigen::Vector3d error_rad(random.normal(), random.normal(), random.normal());
  error_rad *= noise.sigma_deg * kRadPerDeg;
  std::optional<HostTime> before;
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || frame->message_id != MAVLINK_MSG_ID_ATTITUDE) {
      log.add(record);
      continue;
    }
    const double pause_s = before ? seconds(record.received_at - *before) : 0.0;
    const double kept = before ? std::exp(-pause_s / std::max(noise.time_constant_s, 1e-9)) : 1.0;
    const double renewed_rad = std::sqrt(1.0 - kept * kept) * noise.sigma_deg * kRadPerDeg;
    error_rad =
        kept * error_rad + renewed_rad * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    before = record.received_at;
    auto fields = fields_in<mavlink_attitude_t>(*frame);
    fields.roll += static_cast<float>(error_rad.x());
    fields.pitch += static_cast<float>(error_rad.y());
    fields.yaw = static_cast<float>(wrap_to_pi(fields.yaw + error_rad.z()));
    log.add(record.received_at, *frame, payload_with(fields));
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

Flight at_speed(const Flight& flight, double factor) {
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame) continue;
    const Duration recorded_clock = record.received_at - flight.booted_at;
    const Duration boot_clock = from_seconds(seconds(recorded_clock) / factor);
    const HostTime sent_at = flight.booted_at + boot_clock;
    log.add(sent_at, *frame, retell(*frame, {boot_clock, recorded_clock, sent_at, factor}));
  }
  return {flight.name, log.build(), flight.truth.at_speed(factor), flight.booted_at};
}

Flight with_stopped_clock(const Flight& flight, double pause_s) {
  const TimeSpan survey = flight.truth.survey();
  const HostTime stops_at = flight.host_time(survey.begin + (survey.end - survey.begin) / 2);
  const Duration pause = from_seconds(pause_s);
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame) continue;
    if (record.received_at <= stops_at || pause <= Duration::zero()) {
      log.add(record);
    } else if (record.received_at > stops_at + pause) {
      const Duration clock = record.received_at - flight.booted_at;
      log.add(record.received_at, *frame, retell(*frame, {clock - pause, clock, record.received_at, 1.0}));
    }
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

Flight at_telemetry_rate(const Flight& flight, double rate_hz) {
  const Duration period = from_seconds(1.0 / rate_hz);
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || !tells_state(frame->message_id)) log.add(record);
  }
  for (const RecordedStream& stream : recorded_streams(flight)) {
    if (!tells_state(stream.message_id)) continue;
    const bool is_dense_enough = stream.period <= period + period / 50;
    if (!is_dense_enough && stream.message_id == MAVLINK_MSG_ID_ATTITUDE) {
      fill_up<AttitudeTelling>(stream, first_stamp(stream), period, flight, log);
    } else if (!is_dense_enough && stream.message_id == MAVLINK_MSG_ID_GLOBAL_POSITION_INT) {
      fill_up<PositionTelling>(stream, first_stamp(stream), period, flight, log);
    } else {
      thin_out(stream, period, flight, log);
    }
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

Duration period_of(const Stills& stills, const Flight& flight) {
  const TimeSpan survey = flight.truth.survey();
  return std::chrono::floor<std::chrono::milliseconds>((survey.end - survey.begin) / stills.count);
}

Flight as_stills(const Flight& flight, const Stills& stills) {
  const Duration period = period_of(stills, flight);
  const VehicleTime first = flight.truth.survey().begin;
  LogBuilder log, told;
  for (const RecordedStream& stream : recorded_streams(flight)) {
    if (stream.message_id == MAVLINK_MSG_ID_ATTITUDE)
      fill_up<AttitudeTelling>(stream, first, period, flight, told);
    if (stream.message_id == MAVLINK_MSG_ID_GLOBAL_POSITION_INT)
      fill_up<PositionTelling>(stream, first, period, flight, told);
  }
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || !tells_state(frame->message_id)) log.add(record);
  }
  const auto turned_until = [&](std::int64_t picture) {
    return (picture * stills.turned + stills.count / 2) / stills.count;
  };
  const io::Tlog telemetry = told.build();
  for (const io::TlogRecord& record : telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    const auto picture =
        std::llround(seconds(record.received_at - flight.host_time(first)) / seconds(period));
    if (frame->message_id == MAVLINK_MSG_ID_ATTITUDE && turned_until(picture + 1) > turned_until(picture)) {
      auto fields = fields_in<mavlink_attitude_t>(*frame);
      fields.yaw = static_cast<float>(wrap_to_pi(fields.yaw + kPi));
      log.add(record.received_at, *frame, payload_with(fields));
    } else {
      log.add(record);
    }
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

}  // namespace geoloc::sim
