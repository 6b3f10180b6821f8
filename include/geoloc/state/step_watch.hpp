// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "geoloc/state/samples.hpp"
#include "geoloc/state/step_detector.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// Watches the samples of a vehicle's position and attitude for steps that the vehicle cannot have made. Roll
/// and pitch are not watched: they are corrected by gravity within seconds.
class StepWatch {
 public:
  StepWatch();

  /// The steps of the position up to this sample; nullopt for one that comes late.
  std::optional<StateSteps> observe(VehicleTime time, const Eigen::Vector3d& position_in_enu,
                                    const std::optional<Eigen::Vector3d>& velocity_in_enu = std::nullopt);

  /// The same of the attitude.
  std::optional<StateSteps> observe(const AttitudeSample& sample);

  StateSteps steps_of_position() const;
  StateSteps steps_of_attitude() const;

  std::uint32_t horizontal_steps() const { return horizontal_.steps().count; }
  std::uint32_t height_steps() const { return height_.steps().count; }
  std::uint32_t yaw_steps() const { return yaw_.steps().count; }

  /// What comes next does not go on from here; the steps so far count.
  void restart();

 private:
  StepDetector<2> horizontal_;
  StepDetector<1> height_;
  StepDetector<1> yaw_;
  double yaw_rad_ = 0.0;  // of the newest attitude, with all turns
  std::optional<VehicleTime> newest_position_;
  std::optional<VehicleTime> newest_attitude_;
};

}  // namespace geoloc
