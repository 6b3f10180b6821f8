// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace geoloc {

/// k1 k2 p1 p2 k3.
using DistortionCoefficients = std::array<double, 5>;

/// A point in normalized coordinates as the lens shows it, and the derivative by the point, which is
/// symmetric.
template <typename Number>
struct Distorted {
  Number x, y;
  Number x_by_x, x_by_y, y_by_y;
};

/// OpenCV's model. Number: double, or Lanes.
template <typename Number>
Distorted<Number> distort(const Number& x, const Number& y, const DistortionCoefficients& coefficients) {
  const auto [k1, k2, p1, p2, k3] = coefficients;
  const Number r2 = x * x + y * y;
  const Number radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const Number radial_slope = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);  // d radial / d r2
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
          radial + 2.0 * x * x * radial_slope + 2.0 * p1 * y + 6.0 * p2 * x,
          2.0 * x * y * radial_slope + 2.0 * p1 * x + 2.0 * p2 * y,
          radial + 2.0 * y * y * radial_slope + 6.0 * p1 * y + 2.0 * p2 * x};
}

/// Newton's method inverts the lens, from the distorted point.
struct Undistortion {
  static constexpr int kMaxSteps = 20;
  static constexpr double kTolerance = 1e-12;
  static constexpr double kLeastDeterminant = 1e-9;  // of the derivative, where it leads anywhere
};

}  // namespace geoloc
