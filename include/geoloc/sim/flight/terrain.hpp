// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/projection/height_grid.hpp"

namespace geoloc::sim {

/// Height of the ground that targets stand on: waves of 30 to 80 m about a level.
struct Terrain {
  double hills_m = 0.0;             ///< amplitude of the waves; the height's standard deviation is 0.88 of it
  double level_above_home_m = 0.0;  ///< of the whole ground: where the vehicle takes off elsewhere

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;

  double height_above_home_m(const Eigen::Vector2d& position_in_enu) const;
};

/// The targets with their heights above home.
std::vector<Eigen::Vector3d> standing_on(const Terrain& terrain,
                                         const std::vector<Eigen::Vector2d>& positions_in_enu);

/// What an elevation model says of the terrain within 200 m of home, with nodes so far apart: heights above
/// mean sea level where home is `home_msl_m` above it.
HeightGrid elevation_model(const Terrain& terrain, const LocalFrame& frame, double spacing_m,
                           double home_msl_m);

/// The same as an ESRI ASCII grid, which GDAL reads, and the text of the `.prj` file that says that it is in
/// latitude and longitude.
std::string to_ascii_grid(const HeightGrid& model);
std::string wgs84_prj();

}  // namespace geoloc::sim
