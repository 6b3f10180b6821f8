// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace geoloc {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kDegPerRad = 180.0 / kPi;

/// The same angle [rad] in [-pi, pi].
inline double wrap_to_pi(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * kPi);
}

}  // namespace geoloc
