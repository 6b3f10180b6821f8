// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
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

/// The distance to the ground that a rangefinder looking down the body's axis measures.
struct RangeSample {
  VehicleTime time;
  double distance_m = 0.0;
};

}  // namespace geoloc
