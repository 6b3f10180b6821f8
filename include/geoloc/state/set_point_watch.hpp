// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "geoloc/geometry/attitude.hpp"

namespace geoloc {

/// Watches whether a gimbal reports how it holds its camera or how it was told to: what is measured is noisy
/// while the vehicle shakes, and a set-point goes evenly. Yaw is not looked at, since a gimbal that follows
/// the vehicle may pass its noise on.
class SetPointWatch {
 public:
  void observe(const Eigen::Quaterniond& level_from_gimbal);
  void note_vehicle(const EulerAngles& angles);

  /// What comes next does not go on from here; what was found stays.
  void restart();

  bool is_set_point() const { return is_set_point_; }

 private:
  bool is_even(const Eigen::Vector2d& tilt) const;
  void judge();

  std::optional<Eigen::Quaterniond> last_;
  Eigen::Vector2d tilt_before_ = Eigen::Vector2d::Zero();  // from sample to sample, about level axes [rad]
  Eigen::Vector2d tilt_ = Eigen::Vector2d::Zero();
  std::optional<EulerAngles> vehicle_;
  double vehicle_shaken_rad_ = 0.0;  // since samples_ was zero
  int samples_ = 0;
  int even_samples_ = 0;
  bool is_set_point_ = false;
};

}  // namespace geoloc
