// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/rangefinder.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/random.hpp"
#include "sim/live/log_builder.hpp"

namespace geoloc::sim {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr double kLeast_m = 0.2, kMost_m = 60.0;
constexpr double kNoise_m = 0.05, kNoiseShare = 0.01, kScaleShare = 0.01;
constexpr double kWildShare = 0.02;

/// Length of the beam to the ground, by halving; nullopt beyond kMost_m.
std::optional<double> beam_m(const Rigid3d& enu_from_body, const Terrain& terrain) {
  const Eigen::Vector3d down = enu_from_body.rotation * Eigen::Vector3d::UnitZ();
  const auto is_above = [&](double length_m) {
    const Eigen::Vector3d end = enu_from_body.translation + length_m * down;
    return end.z() > terrain.height_above_home_m(end.head<2>());
  };
  if (!is_above(0.0) || is_above(kMost_m)) return std::nullopt;
  double above_m = 0.0, below_m = kMost_m;
  while (below_m - above_m > 1e-4) {
    const double middle_m = 0.5 * (above_m + below_m);
    (is_above(middle_m) ? above_m : below_m) = middle_m;
  }
  return above_m;
}

/// The autopilot's own messages tell who sends.
FrameView sender_of(const Flight& flight) {
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (frame && frame->message_id == kAttitudeId)
      return {MAVLINK_MSG_ID_DISTANCE_SENSOR, frame->system_id, frame->component_id};
  }
  return {MAVLINK_MSG_ID_DISTANCE_SENSOR, 1, 1};
}

}  // namespace

Flight with_rangefinder(const Flight& flight, const Terrain& terrain, std::uint64_t seed) {
  Random random(stream_seed(seed, RandomStream::kRangefinder));
  const double scale = 1.0 + kScaleShare * random.normal();
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) log.add(record);
  const FrameView sender = sender_of(flight);
  const TimeSpan span = flight.truth.span();
  for (VehicleTime time = span.begin; time <= span.end; time += from_seconds(kPeriod_s)) {
    const double noise_m = random.normal(), wild_m = random.uniform(kLeast_m, kMost_m);
    const bool is_wild = random.chance(kWildShare);
    const auto true_m = beam_m(flight.truth.pose(time).value(), terrain);
    if (!true_m) continue;
    const double told_m = is_wild ? wild_m : scale * *true_m + (kNoise_m + kNoiseShare * *true_m) * noise_m;
    mavlink_distance_sensor_t fields{};
    fields.time_boot_ms = static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
    fields.min_distance = static_cast<std::uint16_t>(kLeast_m * 100.0);
    fields.max_distance = static_cast<std::uint16_t>(kMost_m * 100.0);
    fields.current_distance =
        static_cast<std::uint16_t>(std::lround(100.0 * std::clamp(told_m, 0.0, kMost_m)));
    fields.orientation = MAV_SENSOR_ROTATION_PITCH_270;
    fields.covariance = UINT8_MAX;
    log.add(flight.host_time(time), sender, payload_with(fields));
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

}  // namespace geoloc::sim
