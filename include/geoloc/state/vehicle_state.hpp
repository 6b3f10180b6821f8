// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc {

enum class AttitudeInterpolation {
  kCircular,  ///< roll, pitch and yaw each by itself (paper, eq. 5)
  kSlerp      ///< the shortest rotation
};

/// Which way a gimbal's yaw is taken to be told.
enum class GimbalYawReading {
  kAsTold,    ///< by the gimbal's own flags, until the vehicle's turns contradict them
  kFromNose,  ///< from the vehicle's nose, whatever the flags say
  kFromNorth
};

struct StateConfig {
  AttitudeInterpolation attitude_interpolation = AttitudeInterpolation::kSlerp;
  double max_gap_s = 3.0;              ///< a longer hole in the telemetry gives no state
  double max_extrapolation_s = 0.005;  ///< beyond the newest sample; more is guessing
  GimbalYawReading gimbal_yaw = GimbalYawReading::kAsTold;

  std::vector<std::string> problems() const;
};

/// Steps of the state that the vehicle itself did not make: a GNSS glitch and its end, a filter's reset, a
/// new base station. Sums since the flight's start; components are east, north, up [m], yaw [rad, clockwise].
struct StateSteps {
  std::uint32_t segment = 0;  ///< rises with each
  Eigen::Vector4d size = Eigen::Vector4d::Zero();
  Eigen::Vector4d variance = Eigen::Vector4d::Zero();  ///< of the size
};

/// Where the vehicle was at one instant.
struct VehicleState {
  VehicleTime time;
  Rigid3d enu_from_body;  ///< up is the height above home
  /// From axes to the vehicle's north, east and down: true north, but for what its yaw has stepped by.
  Eigen::Quaterniond enu_from_vehicle_ned = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity_in_enu = Eigen::Vector3d::Zero();  ///< [m/s], of the interpolation's segment
  Eigen::Vector3d angular_velocity_in_body =
      Eigen::Vector3d::Zero();               ///< [rad/s], of the interpolation's segment
  std::optional<double> sigma_horizontal_m;  ///< what the receiver last claimed
  double sigma_position_m = 0.0;             ///< that interpolation adds, per horizontal axis
  double sigma_turn_rad = 0.0;               ///< the same, about each axis
  double sigma_bend_rad = 0.0;  ///< besides, about the axis of a turn that may begin or end in between
  Duration telemetry_gap{};     ///< between the samples around: what interpolation is off by lasts so long
  StateSteps steps;             ///< up to now; they are taken out of the pose, which goes on as before them
};

/// How a gimbal held its camera at one instant.
struct GimbalState {
  Eigen::Quaterniond enu_from_gimbal = Eigen::Quaterniond::Identity();  ///< forward, right, down
  Eigen::Vector3d turn_rate_in_enu = Eigen::Vector3d::Zero();           ///< [rad/s]
  double sigma_turn_rad = 0.0;  ///< about each axis: interpolation, and angles that are no measurements
  double sigma_bend_rad = 0.0;  ///< as VehicleState's
  Duration gap{};               ///< between the samples around
};

/// Why there is no state at a time.
enum class NoState {
  kNotYet,     ///< newer than the newest sample: ask again when more have come
  kTooOld,     ///< older than the oldest sample kept
  kInAGap,     ///< between two samples that lie too far apart
  kNoSamples,  ///< nothing has come yet
  kNoGimbal    ///< the camera is on a gimbal, and nothing has come of that yet
};

}  // namespace geoloc
