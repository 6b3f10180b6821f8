// SPDX-License-Identifier: Apache-2.0
#include "io/logs/px4_plane.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::io {

Geodetic from_px4_plane(const Geodetic& reference, double north_m, double east_m) {
  constexpr double kRadius_m = 6'371'000.0;
  const double distance_rad = std::hypot(north_m, east_m) / kRadius_m;
  if (distance_rad == 0.0) return reference;
  const double bearing_rad = std::atan2(east_m, north_m);
  const double latitude_rad = reference.latitude_deg * kRadPerDeg;
  const double sine = std::sin(latitude_rad) * std::cos(distance_rad) +
                      std::cos(latitude_rad) * std::sin(distance_rad) * std::cos(bearing_rad);
  const double turn_rad = std::atan2(std::sin(bearing_rad) * std::sin(distance_rad) * std::cos(latitude_rad),
                                     std::cos(distance_rad) - std::sin(latitude_rad) * sine);
  return {std::asin(sine) * kDegPerRad, reference.longitude_deg + turn_rad * kDegPerRad};
}

}  // namespace geoloc::io
