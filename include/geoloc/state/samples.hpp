// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// The vehicle's attitude as the autopilot reports it (paper, eq. 2).
struct AttitudeSample {
  VehicleTime time;
  EulerAngles angles;
  /// Rates of turn about the body's axes, forward, right and down, where the sample tells them.
  std::optional<Eigen::Vector3d> rates_in_body_radps = std::nullopt;
};

/// The vehicle's position as the autopilot reports it (paper, eq. 1).
struct PositionSample {
  VehicleTime time;
  Geodetic position;
  double height_above_home_m = 0.0;
  /// Above mean sea level, where the autopilot tells it: for outputs and the scale of metres; metres off on
  /// real vehicles.
  std::optional<double> height_msl_m;
  std::optional<double> sigma_horizontal_m;  ///< 1-sigma that the receiver claims, where it does
  std::optional<Eigen::Vector3d> velocity_in_enu = std::nullopt;  ///< [m/s], where it tells it
};

/// What a gimbal's yaw counts from.
enum class GimbalYaw {
  kFromNose,  ///< from where the vehicle's nose points
  kFromNorth
};

/// How a gimbal holds its camera, as it reports it. Roll and pitch are against the horizon: what of the
/// vehicle's tilt the gimbal takes out does not pass through the body.
struct GimbalSample {
  VehicleTime time;
  /// From the gimbal's axes (forward, right, down) to level ones: x to the nose or to the north, z down.
  Eigen::Quaterniond level_from_gimbal = Eigen::Quaterniond::Identity();
  GimbalYaw yaw = GimbalYaw::kFromNose;
  /// Whether it says that it holds a direction over ground, or turns with the vehicle; nullopt: it does not
  /// say.
  std::optional<bool> holds_direction = std::nullopt;
};

/// What a camera that zooms says of how much it shows. Where both angles are known, the horizontal one is
/// used.
struct FieldOfViewSample {
  VehicleTime time;
  std::optional<double> horizontal_rad;  ///< between the left and the right edge of the image
  std::optional<double> vertical_rad;    ///< between its upper and its lower edge
};

/// The distance to the ground that a rangefinder looking down the body's axis measures.
struct RangeSample {
  VehicleTime time;
  double distance_m = 0.0;
};

}  // namespace geoloc
