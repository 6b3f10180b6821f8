// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/circular_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::io {
namespace {

/// Share of a Gaussian (major axis 1, minor axis `ratio`) within `radius`. In polar coordinates the radius
/// integrates in closed form. The rest is smooth in x = radius sin(t) and integrated by the midpoint rule
/// over t.
double share_within(double radius, double ratio) {
  constexpr int kSteps = 256;
  const double step = 0.5 * kPi / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    const double x = radius * std::sin(t), half_chord = radius * std::cos(t);
    const double across = ratio > 0.0 ? std::erf(half_chord / (ratio * std::sqrt(2.0))) : 1.0;
    sum += std::exp(-0.5 * x * x) * across * half_chord;
  }
  return sum * step * std::sqrt(2.0 / kPi);
}

}  // namespace

double circular_error(double sigma_major, double sigma_minor, double probability) {
  const double major = std::max(sigma_major, sigma_minor), minor = std::min(sigma_major, sigma_minor);
  const bool is_usable =
      minor >= 0.0 && std::isfinite(sigma_major + sigma_minor) && probability > 0.0 && probability < 1.0;
  if (!is_usable) return std::numeric_limits<double>::quiet_NaN();
  if (major == 0.0) return 0.0;
  double low = 0.0, high = 12.0;  // sigmas
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (low + high);
    (share_within(middle, minor / major) < probability ? low : high) = middle;
  }
  return major * 0.5 * (low + high);
}

}  // namespace geoloc::io
