// SPDX-License-Identifier: Apache-2.0
#include "import/way.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::apps {

Eigen::Vector3d way(const PositionSample& from, const PositionSample& to) {
  const double east_deg = std::remainder(to.position.longitude_deg - from.position.longitude_deg, 360.0);
  return {east_deg * std::cos(from.position.latitude_deg * kRadPerDeg) * kMetresPerDegree,
          (to.position.latitude_deg - from.position.latitude_deg) * kMetresPerDegree,
          to.height_above_home_m - from.height_above_home_m};
}

}  // namespace geoloc::apps
