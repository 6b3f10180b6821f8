// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"

// Telemetry in a video's own frames: user_data_unregistered messages of H.264 and H.265 that hold JSON of the
// schema apcg.telemetry.v1, as AP_CameraGimbal, ArduPilot's firmware for cameras, writes it.
namespace geoloc::io {

/// The camera's own clock, since the UNIX epoch if it is set at all. A tag, as in geometry/time.hpp.
using CameraTime = Clock<struct CameraClockTag>::time_point;

/// What tells these messages from others (ITU-T H.264, D.1.7).
inline constexpr std::array<std::uint8_t, 16> kTelemetryUuid{0x8d, 0x64, 0x6b, 0x4e, 0x55, 0x6f, 0x4a, 0x90,
                                                             0x8b, 0x7c, 0x35, 0xe6, 0x29, 0x51, 0x03, 0x21};

/// A frame's telemetry: what was known when the frame was put into the stream, which is some time after its
/// exposure. What is unknown is nullopt. Ages are those of the values then.
struct VideoTelemetry {
  struct Position {
    Geodetic position;
    double height_msl_m = 0.0;
    double height_above_home_m = 0.0;
    Duration age{};
  };
  struct Velocity {
    Eigen::Vector3d velocity_in_enu = Eigen::Vector3d::Zero();  ///< [m/s]
    Duration age{};
  };
  struct Attitude {
    EulerAngles angles;
    Duration age{};
  };

  CameraTime made_at;
  std::optional<Position> position;
  std::optional<Velocity> velocity;
  std::optional<Attitude> vehicle;  ///< its yaw from north
  std::optional<Attitude> gimbal;   ///< roll and pitch against the horizon, yaw from the vehicle's nose
  std::optional<double> zoom;       ///< factor; of the field of view, it is already in the next
  std::optional<double> horizontal_fov_deg;
  int refused_values = 0;  ///< groups that were told, but cannot be: taken as unknown
};

/// Longer than ten records; texts beyond it are refused.
inline constexpr std::size_t kLongestTelemetry = 16 * 1024;

/// Reads the JSON behind the UUID. Takes any bytes. nullopt where they are no record of the schema, or tell
/// no time. Values that are not finite, out of range, or older than ten seconds are taken as unknown and
/// counted.
std::optional<VideoTelemetry> parse_video_telemetry(std::string_view json);

/// The inverse. Ages are rounded down to milliseconds.
std::string to_json(const VideoTelemetry& telemetry);

}  // namespace geoloc::io
