// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/zoom_flight.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "geoloc/camera/field_of_view.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/random.hpp"
#include "sim/live/log_builder.hpp"

namespace geoloc::sim {
namespace {

constexpr Duration kFieldOfViewPeriod = std::chrono::milliseconds{200};
constexpr Duration kCameraHeartbeatPeriod = std::chrono::seconds{1};
constexpr Duration kMotorLag = std::chrono::milliseconds{50};
constexpr double kSecondsPerDoubling = 0.7;
constexpr double kNominalSigma = 0.01;
constexpr double kTold_deg = 0.1;  // fields of view are told in steps of that

/// From one look to the next.
ZoomTrajectory draw_zoom(const TimeSpan& span, const ZoomSettings& settings, Random& random) {
  std::vector<ZoomTrajectory::Sample> samples{{span.begin, settings.least}};
  const auto add = [&](double after_s, double zoom) {
    samples.emplace_back(samples.back().first + from_seconds(after_s), zoom);
  };
  while (samples.back().first < span.end) {
    const double look = settings.least * std::pow(settings.most / settings.least, random.uniform(0.0, 1.0));
    const double run_s = std::max(0.1, kSecondsPerDoubling * std::log2(look / settings.least));
    add(random.uniform(4.0, 8.0), settings.least);
    add(run_s, look);
    add(random.uniform(2.0, 4.0), look);
    add(run_s, settings.least);
  }
  return ZoomTrajectory(std::move(samples));
}

float told_angle_deg(int size_px, double focal_px) {
  const double angle_deg = angle_of_view_rad(size_px, focal_px) * kDegPerRad;
  return static_cast<float>(std::round(angle_deg / kTold_deg) * kTold_deg);
}

Payload field_of_view(std::uint32_t time_boot_ms, double zoom, const CameraIntrinsics& camera) {
  constexpr auto kUnknown = std::numeric_limits<std::int32_t>::max();
  mavlink_camera_fov_status_t fields{};
  fields.time_boot_ms = time_boot_ms;
  fields.lat_camera = fields.lon_camera = fields.alt_camera = kUnknown;
  fields.lat_image = fields.lon_image = fields.alt_image = kUnknown;
  for (float& part : fields.q) part = NAN;
  fields.hfov = told_angle_deg(camera.width_px, zoom * camera.fx_px);
  fields.vfov = told_angle_deg(camera.height_px, zoom * camera.fy_px);
  return payload_with(fields);
}

Payload camera_heartbeat() {
  mavlink_heartbeat_t fields{};
  fields.type = MAV_TYPE_CAMERA;
  fields.autopilot = MAV_AUTOPILOT_INVALID;
  fields.system_status = MAV_STATE_ACTIVE;
  fields.mavlink_version = 3;
  return payload_with(fields);
}

}  // namespace

std::vector<std::string> ZoomSettings::problems() const {
  Problems found;
  found.require(least >= 0.1 && least <= most && most <= 100.0,
                "zooms must lie in [0.1, 100], the least first");
  return found.take();
}

Flight with_zoom(const Flight& flight, const ZoomSettings& settings, const CameraIntrinsics& camera,
                 std::uint64_t seed) {
  refuse_if_any(settings.problems());
  Random random(stream_seed(seed, RandomStream::kZoom));
  const TimeSpan span = flight.truth.span();
  const double nominal = 1.0 + kNominalSigma * random.normal();
  const Duration clock_offset = from_seconds(random.uniform(1.0, 60.0));
  const ZoomTrajectory zoom = draw_zoom(span, settings, random);
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) log.add(record);
  for (VehicleTime time = span.begin; time <= span.end; time += kFieldOfViewPeriod) {
    const auto camera_time =
        std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch() + clock_offset);
    const HostTime received_at = flight.host_time(time) + from_seconds(random.uniform(0.02, 0.08));
    log.add(received_at, {MAVLINK_MSG_ID_CAMERA_FOV_STATUS, 1, MAV_COMP_ID_CAMERA},
            field_of_view(static_cast<std::uint32_t>(camera_time.count()),
                          nominal * zoom.zoom(time - kMotorLag), camera));
  }
  for (VehicleTime time = span.begin; time <= span.end; time += kCameraHeartbeatPeriod)
    log.add(flight.host_time(time), {MAVLINK_MSG_ID_HEARTBEAT, 1, MAV_COMP_ID_CAMERA}, camera_heartbeat());
  return {flight.name, log.build(), flight.truth, flight.booted_at, flight.gimbal, zoom};
}

}  // namespace geoloc::sim
