// SPDX-License-Identifier: Apache-2.0
#include "common/video_vehicle.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

constexpr Duration kOldest = 1s;
/// Ages are in whole milliseconds, and read a moment before the record's own time.
constexpr Duration kSameMoment = 5ms;
constexpr Duration kHeartbeatPeriod = 1s;
/// The vehicle's clock counts from so long before the first record: no age leads to before its boot.
constexpr Duration kSinceBoot = 1min;

/// When the value was so, unless that was told before, or is long ago. Then it is the last one that was told.
std::optional<HostTime> new_time(HostTime made_at, Duration age, std::optional<HostTime>& told_at) {
  const HostTime at = made_at - age;
  const bool is_told = told_at && at < *told_at + kSameMoment && at > *told_at - kOldest;
  if (age > kOldest || is_told) return std::nullopt;
  told_at = at;
  return at;
}

/// By the position before; zero where there is none.
Eigen::Vector3d velocity_between(const std::optional<PositionSample>& before, const PositionSample& after) {
  const double span_s = before ? seconds(after.time - before->time) : 0.0;
  if (!(span_s > 0.0) || span_s > seconds(kOldest)) return Eigen::Vector3d::Zero();
  Eigen::Vector3d way;
  way << LocalFrame(before->position).to_local(after.position).position_in_enu,
      after.height_above_home_m - before->height_above_home_m;
  return way / span_s;
}

}  // namespace

VehicleTime VideoVehicle::boot_time(HostTime at) const {
  return VehicleTime{at - *booted_at_};
}

io::OutgoingFrame VideoVehicle::message(const Due& due, const io::VideoTelemetry& record) {
  switch (due.kind) {
    case Kind::kAttitude:
      return writer_.attitude({boot_time(due.at), record.vehicle->angles});
    case Kind::kPosition:
      return writer_.position(position_sample(due.at, record));
    case Kind::kGimbal:
      return writer_.gimbal({boot_time(due.at), ned_from_body(record.gimbal->angles), GimbalYaw::kFromNose});
    case Kind::kFieldOfView:
      return writer_.field_of_view(
          {boot_time(due.at), *record.horizontal_fov_deg * kRadPerDeg, std::nullopt});
  }
  return writer_.heartbeat();
}

PositionSample VideoVehicle::position_sample(HostTime at, const io::VideoTelemetry& record) {
  PositionSample sample;
  sample.time = boot_time(at);
  sample.position = record.position->position;
  sample.height_above_home_m = record.position->height_above_home_m;
  sample.height_msl_m = record.position->height_msl_m;
  sample.velocity_in_enu =
      record.velocity ? record.velocity->velocity_in_enu : velocity_between(last_position_, sample);
  last_position_ = sample;
  return sample;
}

/// Messages are numbered as they are written, so they are put in the order of their times before.
void VideoVehicle::tell(HostTime made_at, const io::VideoTelemetry& record, const Tell& tell) {
  if (!booted_at_) booted_at_ = made_at - kSinceBoot;
  if (!heartbeat_at_ || std::chrono::abs(made_at - *heartbeat_at_) >= kHeartbeatPeriod) {
    heartbeat_at_ = made_at;
    const io::OutgoingFrame heartbeat = writer_.heartbeat();
    tell(made_at, heartbeat.bytes.data(), heartbeat.size);
  }
  std::vector<Due> due;
  const auto add = [&](const auto& value, Kind kind) {
    if (!value) return;
    const auto at = new_time(made_at, value->age, told_at_[static_cast<std::size_t>(kind)]);
    if (at) due.push_back({*at, kind});
  };
  add(record.vehicle, Kind::kAttitude);
  add(record.position, Kind::kPosition);
  add(record.gimbal, Kind::kGimbal);
  if (record.horizontal_fov_deg) due.push_back({made_at, Kind::kFieldOfView});
  std::stable_sort(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.at < b.at; });
  for (const Due& next : due) {
    const io::OutgoingFrame frame = message(next, record);
    tell(next.at, frame.bytes.data(), frame.size);
  }
}

}  // namespace geoloc::apps
