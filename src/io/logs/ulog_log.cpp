// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"
#include "io/logs/log_builder.hpp"
#include "io/logs/px4_plane.hpp"
#include "io/logs/ulog.hpp"

namespace geoloc::io {
namespace {

const UlogTopics kTopics{"vehicle_attitude",
                         "vehicle_global_position",
                         "vehicle_local_position",
                         "vehicle_gps_position",
                         "sensor_gps",
                         "home_position",
                         "gimbal_device_attitude_status",
                         "mount_orientation",
                         "camera_capture",
                         "camera_trigger",
                         "vehicle_command"};

std::optional<double> finite(const UlogSample& sample, std::string_view field) {
  const auto value = sample.number(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// When the state was so, where the topic tells it, rather than when it was told.
std::optional<VehicleTime> time_of(const UlogSample& sample) {
  auto time_us = sample.number("timestamp_sample");
  if (time_us.value_or(0.0) <= 0.0) time_us = sample.number("timestamp");
  if (!time_us || !is_time_us(*time_us)) return std::nullopt;
  return time_from_us(*time_us);
}

std::optional<Eigen::Vector3d> vector_of(const UlogSample& sample, const std::array<const char*, 3>& names) {
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = finite(sample, names[i]);
    if (!value) return std::nullopt;
    vector[static_cast<Eigen::Index>(i)] = *value;
  }
  return vector;
}

/// `q` turns from the body to north, east, down; w first.
std::optional<EulerAngles> angles_of(const UlogSample& sample) {
  const auto w = finite(sample, "q[0]");
  const auto xyz = vector_of(sample, {"q[1]", "q[2]", "q[3]"});
  if (!w || !xyz) return std::nullopt;
  const Eigen::Quaterniond turn(*w, xyz->x(), xyz->y(), xyz->z());
  if (!(std::abs(turn.norm() - 1.0) < 0.1)) return std::nullopt;
  return euler_angles(turn.normalized());
}

/// In degrees or, in older logs, 1e-7 degrees.
std::optional<Geodetic> fix_place(const UlogSample& sample) {
  const auto latitude_deg = finite(sample, "latitude_deg"), longitude_deg = finite(sample, "longitude_deg");
  if (latitude_deg && longitude_deg) return Geodetic{*latitude_deg, *longitude_deg};
  const auto latitude = finite(sample, "lat"), longitude = finite(sample, "lon");
  if (!latitude || !longitude) return std::nullopt;
  return Geodetic{*latitude / 1e7, *longitude / 1e7};
}

/// Takes the samples one by one.
class UlogCollector {
 public:
  void take(const UlogSample& sample) {
    const auto time = time_of(sample);
    if (!time) return;
    const std::string& topic = sample.topic();
    if (topic == "vehicle_attitude") {
      if (const auto angles = angles_of(sample)) keep(log_.attitudes, {*time, *angles});
    } else if (topic == "vehicle_global_position") {
      take_global(sample, *time);
    } else if (topic == "vehicle_local_position") {
      take_local(sample, *time);
    } else if (topic == "vehicle_gps_position" || topic == "sensor_gps") {
      take_fix(sample, *time, topic == "sensor_gps" ? sensor_fixes_ : log_.fixes);
    } else {
      take_rare(sample, *time);
    }
  }

  FlightLog finished(const UlogDamage& damage) {
    if (log_.fixes.empty()) log_.fixes = std::move(sensor_fixes_);
    if (log_.positions.empty() && !local_positions_.empty()) {
      log_.positions = std::move(local_positions_);
      log_.assumptions.emplace_back(
          "the log has no vehicle_global_position: positions are those of vehicle_local_position about its "
          "reference");
    }
    log_.skipped_bytes = damage.skipped_bytes;
    log_.dropouts = damage.dropouts;
    finish(log_);
    return std::move(log_);
  }

 private:
  void take_global(const UlogSample& sample, VehicleTime time) {
    const auto latitude_deg = finite(sample, "lat"), longitude_deg = finite(sample, "lon");
    if (!latitude_deg || !longitude_deg || sample.number("lat_lon_valid") == 0.0) return;
    const Geodetic place{*latitude_deg, *longitude_deg};
    if (is_place(place))
      keep(log_.positions,
           {time, place, {std::nullopt, finite(sample, "alt"), finite(sample, "alt_ellipsoid")}});
  }

  void take_local(const UlogSample& sample, VehicleTime time) {
    const auto velocity = vector_of(sample, {"vx", "vy", "vz"});
    if (velocity && sample.number("v_xy_valid") != 0.0)
      keep(log_.velocities, {time, Eigen::Vector3d(velocity->y(), velocity->x(), -velocity->z())});
    const auto place = vector_of(sample, {"x", "y", "z"});
    const auto reference = vector_of(sample, {"ref_lat", "ref_lon", "ref_alt"});
    if (!place || !reference || sample.number("xy_global") == 0.0 || sample.number("xy_valid") == 0.0) return;
    const Geodetic origin{reference->x(), reference->y()};
    if (!is_place(origin)) return;
    const Geodetic here = from_px4_plane(origin, place->x(), place->y());
    if (is_place(here))
      keep(local_positions_, {time, here, {std::nullopt, reference->z() - place->z(), std::nullopt}});
  }

  void take_fix(const UlogSample& sample, VehicleTime time, std::vector<LoggedFix>& fixes) {
    const auto accuracy = [&](const char* field) -> std::optional<double> {
      const auto sigma_m = finite(sample, field);
      return sigma_m && *sigma_m > 0.0 ? sigma_m : std::nullopt;
    };
    LoggedFix fix;
    fix.time = time;
    const auto place = fix_place(sample);
    if (place && is_place(*place)) fix.position = *place;
    fix.height_msl_m = finite(sample, "altitude_msl_m");
    if (const auto height_mm = finite(sample, "alt")) fix.height_msl_m = *height_mm / 1e3;
    fix.fix_type = static_cast<int>(std::clamp(finite(sample, "fix_type").value_or(0.0), 0.0, 8.0));
    fix.sigma_horizontal_m = accuracy("eph");
    fix.sigma_height_m = accuracy("epv");
    const auto utc_us = finite(sample, "time_utc_usec");
    if (utc_us && *utc_us > 0.0 && is_time_us(*utc_us))
      keep(log_.utc, {time, HostTime{std::chrono::microseconds{std::llround(*utc_us)}}});
    keep(fixes, fix);
  }

  void take_rare(const UlogSample& sample, VehicleTime time) {
    const std::string& topic = sample.topic();
    if (topic == "home_position") {
      if (!log_.home_height_msl_m && sample.number("valid_alt") != 0.0)
        log_.home_height_msl_m = finite(sample, "alt");
    } else if (topic == "camera_capture" || (topic == "camera_trigger" && !has_captures_)) {
      // A picture that was triggered and then taken is in both.
      if (topic == "camera_capture" && !std::exchange(has_captures_, true)) drop_exposures(log_);
      keep(log_.camera_events, {time, CameraEventKind::kExposure});
    } else if (topic == "vehicle_command") {
      if (sample.number("command") == kVideoStartCommand)
        keep(log_.camera_events, {time, CameraEventKind::kVideoStart});
    } else if (topic == "gimbal_device_attitude_status" || topic == "mount_orientation") {
      take_gimbal(sample, time);
    }
  }

  void take_gimbal(const UlogSample& sample, VehicleTime time) {
    constexpr unsigned kYawLock = 16, kInVehicleFrame = 32, kInEarthFrame = 64;
    if (sample.topic() == "mount_orientation") {
      const auto angles = vector_of(
          sample, {"attitude_euler_angle[0]", "attitude_euler_angle[1]", "attitude_euler_angle[2]"});
      if (angles && angles->cwiseAbs().maxCoeff() < 10.0)
        keep(log_.gimbal, {time, {angles->x(), angles->y(), wrap_to_pi(angles->z())}, GimbalYaw::kFromNose});
      return;
    }
    const auto angles = angles_of(sample);
    const auto flags =
        static_cast<unsigned>(std::clamp(finite(sample, "device_flags").value_or(0.0), 0.0, 65535.0));
    const bool is_from_north = (flags & (kInVehicleFrame | kInEarthFrame)) != 0 ? (flags & kInEarthFrame) != 0
                                                                                : (flags & kYawLock) != 0;
    if (angles)
      keep(log_.gimbal, {time, *angles, is_from_north ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose,
                         (flags & kYawLock) != 0});
  }

  FlightLog log_;
  std::vector<LoggedPosition> local_positions_;
  std::vector<LoggedFix> sensor_fixes_;
  bool has_captures_ = false;
};

}  // namespace

FlightLog parse_ulog(std::string_view bytes) {
  UlogCollector collector;
  const UlogDamage damage =
      for_each_ulog_sample(bytes, kTopics, [&](const UlogSample& sample) { collector.take(sample); });
  return collector.finished(damage);
}

}  // namespace geoloc::io
