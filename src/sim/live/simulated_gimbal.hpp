// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/live/gimbal_flight.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {

/// A gimbal's axes at one moment, to level ones with x to the north, and what of it is known on board.
struct GimbalMoment {
  Eigen::Quaterniond ned_from_gimbal;
  Eigen::Quaterniond ned_from_measured;
  Eigen::Quaterniond ned_from_set_point;
};

/// The mechanics and sensors of a gimbal, step by step.
class SimulatedGimbal {
 public:
  SimulatedGimbal(const GimbalSettings& settings, std::uint64_t seed);

  /// The next step; `vehicle`: its true attitude then, north being that of the local frame.
  GimbalMoment step(double time_s, double step_s, const EulerAngles& vehicle);

 private:
  EulerAngles set_point(double time_s, double vehicle_yaw_rad) const;
  void follow(const EulerAngles& wanted, double step_s, double vehicle_yaw_rad);

  GimbalSettings settings_;
  Random random_;
  std::optional<EulerAngles> angles_;                    // without what it fails to take out
  Eigen::Vector3d shake_rad_ = Eigen::Vector3d::Zero();  // about its own axes
  Eigen::Vector3d sensor_drift_rad_ = Eigen::Vector3d::Zero();
};

}  // namespace geoloc::sim
