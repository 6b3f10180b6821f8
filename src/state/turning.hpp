// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc {

/// What a vehicle, or its gimbal, does between two samples: RMS of what straight lines between decimated
/// samples of the flights in data/flights are off by, 1 to 5 Hz.
inline constexpr double kAngularAcceleration_radps2 = 8.0 * kRadPerDeg;
/// What is turning may have begun or will end within this.
inline constexpr double kTurnChange_s = 0.5;

inline bool tells_rates(const AttitudeSample& sample) {
  return sample.rates_in_body_radps && sample.rates_in_body_radps->allFinite();
}

/// The shortest turn that is such a rotation, about an axis of the same length [rad].
inline Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return wrap_to_pi(turn.angle()) * turn.axis();
}

}  // namespace geoloc
