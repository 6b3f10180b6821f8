// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/gimbal_flight.hpp"

#include <all/mavlink.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "sim/live/log_builder.hpp"
#include "sim/live/simulated_gimbal.hpp"

namespace geoloc::sim {
namespace {

constexpr Duration kMotionStep = std::chrono::milliseconds{10};
constexpr int kMotionStepsPerMessage = 10;

/// The true angles of the vehicle, north being that of the local frame.
EulerAngles true_angles(const Flight& flight, VehicleTime time) {
  return euler_angles(enu_from_ned() * flight.truth.pose(time).value().rotation);
}

/// What the autopilot's yaw is off by, as its ATTITUDE tells, in straight lines between the messages.
class YawError {
 public:
  explicit YawError(const Flight& flight) {
    for (const io::TlogRecord& record : flight.telemetry.records()) {
      const auto frame = view_frame(record.frame, record.size);
      if (!frame || frame->message_id != MAVLINK_MSG_ID_ATTITUDE) continue;
      const auto fields = fields_in<mavlink_attitude_t>(*frame);
      const VehicleTime time{std::chrono::milliseconds{fields.time_boot_ms}};
      if (!flight.truth.pose(time) || (!errors_.empty() && time <= errors_.back().first)) continue;
      errors_.emplace_back(time, wrap_to_pi(fields.yaw - true_angles(flight, time).yaw_rad));
    }
  }

  /// Times rise.
  double at(VehicleTime time) {
    while (next_ < errors_.size() && errors_[next_].first < time) ++next_;
    if (errors_.empty()) return 0.0;
    if (next_ == 0 || next_ == errors_.size()) return errors_[next_ == 0 ? 0 : next_ - 1].second;
    const auto& [begin, before_rad] = errors_[next_ - 1];
    const auto& [end, after_rad] = errors_[next_];
    return before_rad + seconds(time - begin) / seconds(end - begin) * wrap_to_pi(after_rad - before_rad);
  }

 private:
  std::vector<std::pair<VehicleTime, double>> errors_;
  std::size_t next_ = 0;
};

/// What the gimbal says at one moment.
struct Told {
  std::uint32_t time_boot_ms;
  Eigen::Quaterniond from_nose;
  Eigen::Quaterniond from_north;
};

bool tells_from_north(const GimbalSettings& settings) {
  return settings.told_yaw == GimbalYaw::kFromNorth;
}

Payload device_status(const Told& told, const GimbalSettings& settings) {
  const Eigen::Quaterniond& q = tells_from_north(settings) ? told.from_north : told.from_nose;
  const bool says_from_north = tells_from_north(settings) != settings.has_wrong_flag;
  mavlink_gimbal_device_attitude_status_t fields{};
  fields.time_boot_ms = told.time_boot_ms;
  const std::array<double, 4> wxyz{q.w(), q.x(), q.y(), q.z()};
  std::copy(wxyz.begin(), wxyz.end(), fields.q);
  fields.angular_velocity_x = fields.angular_velocity_y = fields.angular_velocity_z = NAN;
  fields.delta_yaw = fields.delta_yaw_velocity = NAN;
  fields.flags = GIMBAL_DEVICE_FLAGS_ROLL_LOCK | GIMBAL_DEVICE_FLAGS_PITCH_LOCK;
  fields.flags |=
      says_from_north ? GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME : GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME;
  if (settings.holds_direction) fields.flags |= GIMBAL_DEVICE_FLAGS_YAW_LOCK;
  fields.gimbal_device_id = 1;
  return payload_with(fields);
}

float degrees(double angle_rad) {
  return static_cast<float>(angle_rad * kDegPerRad);
}

Payload mount_orientation(const Told& told, const GimbalSettings& settings) {
  const EulerAngles angles = euler_angles(tells_from_north(settings) ? told.from_north : told.from_nose);
  const bool says_from_north = tells_from_north(settings) != settings.has_wrong_flag;
  mavlink_mount_orientation_t fields{};
  fields.time_boot_ms = told.time_boot_ms;
  fields.roll = degrees(angles.roll_rad);
  fields.pitch = degrees(angles.pitch_rad);
  fields.yaw = says_from_north ? NAN : degrees(angles.yaw_rad);
  fields.yaw_absolute = says_from_north ? degrees(angles.yaw_rad) : NAN;
  return payload_with(fields);
}

Payload mount_status(const Told& told) {
  const EulerAngles angles = euler_angles(told.from_nose);
  const auto hundredths = [](double angle_rad) {
    return static_cast<std::int32_t>(std::lround(100.0 * angle_rad * kDegPerRad));
  };
  mavlink_mount_status_t fields{};
  fields.pointing_a = hundredths(angles.pitch_rad);
  fields.pointing_b = hundredths(angles.roll_rad);
  fields.pointing_c = hundredths(angles.yaw_rad);
  return payload_with(fields);
}

void tell(const Told& told, HostTime at, const GimbalSettings& settings, LogBuilder& log) {
  switch (settings.telling) {
    case GimbalTelling::kDeviceStatus:
      return log.add(at, {MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS, 1, 1}, device_status(told, settings));
    case GimbalTelling::kMountOrientation:
      return log.add(at, {MAVLINK_MSG_ID_MOUNT_ORIENTATION, 1, 1}, mount_orientation(told, settings));
    case GimbalTelling::kMountStatus:
      return log.add(at, {MAVLINK_MSG_ID_MOUNT_STATUS, 1, 1}, mount_status(told));
  }
}

Eigen::AngleAxisd about_down(double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ());
}

}  // namespace

Flight with_gimbal(const Flight& flight, const GimbalSettings& settings, std::uint64_t seed) {
  SimulatedGimbal gimbal(settings, stream_seed(seed, RandomStream::kGimbal));
  YawError yaw_error(flight);
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) log.add(record);
  const TimeSpan span = flight.truth.span();
  const VehicleTime first{std::chrono::ceil<std::chrono::milliseconds>(span.begin.time_since_epoch())};
  std::vector<GimbalTrajectory::Sample> truth;
  int step = 0;
  for (VehicleTime time = first; time <= span.end; time += kMotionStep, ++step) {
    const EulerAngles vehicle = true_angles(flight, time);
    const GimbalMoment moment = gimbal.step(seconds(time.time_since_epoch()), seconds(kMotionStep), vehicle);
    truth.emplace_back(time, (enu_from_ned() * moment.ned_from_gimbal).normalized());
    if (step % kMotionStepsPerMessage != 0) continue;
    const Eigen::Quaterniond known =
        settings.tells_set_point ? moment.ned_from_set_point : moment.ned_from_measured;
    const Eigen::Quaterniond from_nose = about_down(-vehicle.yaw_rad) * known;
    const Eigen::Quaterniond from_north = about_down(vehicle.yaw_rad + yaw_error.at(time)) * from_nose;
    const auto boot_ms = std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch());
    tell({static_cast<std::uint32_t>(boot_ms.count()), from_nose, from_north}, flight.host_time(time),
         settings, log);
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at, GimbalTrajectory(std::move(truth))};
}

}  // namespace geoloc::sim
