// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/state/samples.hpp"

// What a log tells of a flight, whatever its format. Times are the log's own: since the vehicle's boot, since
// the video's beginning (subtitles), or since 1970. Each list is in the order of its times.
namespace geoloc::io {

/// Heights of one position, each by what it counts from.
struct LoggedHeights {
  std::optional<double> above_home_m;
  std::optional<double> msl_m;
  std::optional<double> ellipsoid_m;
};

struct LoggedPosition {
  VehicleTime time;
  Geodetic position;
  LoggedHeights heights;
};

struct LoggedVelocity {
  VehicleTime time;
  Eigen::Vector3d velocity_in_enu;  ///< [m/s]
};

/// What the GNSS receiver says.
struct LoggedFix {
  VehicleTime time;
  Geodetic position;
  std::optional<double> height_msl_m;
  int fix_type = 0;                          ///< as MAVLink's GPS_FIX_TYPE; 3 is a fix in three dimensions
  std::optional<double> sigma_horizontal_m;  ///< 1-sigma, radial
  std::optional<double> sigma_height_m;
};

/// How a gimbal looked. Roll and pitch are against the horizon; 0, 0 looks ahead, level.
struct LoggedGimbal {
  VehicleTime time;
  EulerAngles angles;
  GimbalYaw yaw = GimbalYaw::kFromNorth;
};

/// The camera's focal length, as its equivalent for film of 35 mm, from that time on.
struct LoggedFocalLength {
  VehicleTime time;
  double equivalent_mm = 0.0;
};

enum class CameraEventKind {
  kExposure,   ///< a picture was taken
  kVideoStart  ///< a video's recording was begun (MAV_CMD_VIDEO_START_CAPTURE)
};

struct CameraEvent {
  VehicleTime time;
  CameraEventKind kind;
};

/// The same moment on the log's clock and in UTC.
struct UtcPair {
  VehicleTime time;
  HostTime utc;
};

struct FlightLog {
  std::vector<AttitudeSample> attitudes;
  std::vector<LoggedPosition> positions;
  std::vector<LoggedVelocity> velocities;
  std::vector<LoggedFix> fixes;
  std::vector<LoggedGimbal> gimbal;
  std::vector<CameraEvent> camera_events;
  std::vector<UtcPair> utc;
  std::optional<double> home_height_msl_m;       ///< of the first home that is told
  std::vector<LoggedFocalLength> focal_lengths;  ///< the first that is told, and each change of it
  bool is_utc_local = false;                     ///< the times called UTC are of an unknown time zone
  std::size_t skipped_bytes = 0;                 ///< that belong to no record: damage, or a truncated end
  std::size_t dropouts = 0;                      ///< gaps that the log itself reports
  std::vector<std::string> assumptions;          ///< what the log left open, and what was taken, for people
};

}  // namespace geoloc::io
