// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "geoloc/geometry/time.hpp"

namespace geoloc::sim {

/// How a gimbal truly was turned at any time of a flight, along the shortest turn between the samples.
class GimbalTrajectory {
 public:
  using Sample = std::pair<VehicleTime, Eigen::Quaterniond>;  ///< enu_from_gimbal (forward, right, down)

  /// Throws std::invalid_argument unless there are two samples at least and their times rise.
  explicit GimbalTrajectory(std::vector<Sample> samples);

  /// Before and after the samples it stays as it was at the end.
  Eigen::Quaterniond enu_from_gimbal(VehicleTime time) const;

 private:
  std::vector<Sample> samples_;
};

}  // namespace geoloc::sim
