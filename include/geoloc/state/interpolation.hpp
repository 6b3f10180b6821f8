// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "geoloc/geometry/attitude.hpp"

namespace geoloc {

/// How two neighbouring samples are blended; alpha = 0 gives `before`, 1 gives `after`. The primary template
/// is for vector spaces (paper, eq. 3); manifolds specialise it.
template <typename T>
struct Interpolator {
  static T between(const T& before, const T& after, double alpha) {
    return before + alpha * (after - before);
  }
};

/// Shortest rotation at constant rate.
template <>
struct Interpolator<Eigen::Quaterniond> {
  static Eigen::Quaterniond between(const Eigen::Quaterniond& before, const Eigen::Quaterniond& after,
                                    double alpha) {
    return before.slerp(alpha, after);
  }
};

/// Circular interpolation of one angle (paper, eq. 5), any unit of turn free of wrap-around trouble [rad].
inline double interpolate_circular(double before_rad, double after_rad, double alpha) {
  return std::atan2((1.0 - alpha) * std::sin(before_rad) + alpha * std::sin(after_rad),
                    (1.0 - alpha) * std::cos(before_rad) + alpha * std::cos(after_rad));
}

/// Each angle by itself (paper, eq. 5).
template <>
struct Interpolator<EulerAngles> {
  static EulerAngles between(const EulerAngles& before, const EulerAngles& after, double alpha) {
    return {interpolate_circular(before.roll_rad, after.roll_rad, alpha),
            interpolate_circular(before.pitch_rad, after.pitch_rad, alpha),
            interpolate_circular(before.yaw_rad, after.yaw_rad, alpha)};
  }
};

}  // namespace geoloc
