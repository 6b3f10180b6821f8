// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/terrain.hpp"

#include <cmath>

#include "geoloc/geometry/problems.hpp"

namespace geoloc::sim {

std::vector<std::string> Terrain::problems() const {
  Problems found;
  found.require(hills_m >= 0.0 && hills_m <= 100.0, "hills must lie in [0, 100] m");
  found.require(std::abs(level_above_home_m) <= 500.0, "level_above_home must lie in [-500, 500] m");
  return found.take();
}

double Terrain::height_above_home_m(const Eigen::Vector2d& position_in_enu) const {
  const double east_m = position_in_enu.x(), north_m = position_in_enu.y();
  const double waves =
      std::sin(east_m / 13.0) + std::sin(north_m / 9.0 + 1.0) + 0.5 * std::sin((east_m + north_m) / 5.0);
  return level_above_home_m + hills_m * waves / 1.2;
}

std::vector<Eigen::Vector3d> standing_on(const Terrain& terrain,
                                         const std::vector<Eigen::Vector2d>& positions_in_enu) {
  std::vector<Eigen::Vector3d> standing;
  standing.reserve(positions_in_enu.size());
  for (const Eigen::Vector2d& place : positions_in_enu)
    standing.emplace_back(place.x(), place.y(), terrain.height_above_home_m(place));
  return standing;
}

}  // namespace geoloc::sim
