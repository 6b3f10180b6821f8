// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/terrain.hpp"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>

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

HeightGrid elevation_model(const Terrain& terrain, const LocalFrame& frame, double spacing_m,
                           double home_msl_m) {
  constexpr double kReach_m = 200.0;
  const Geodetic south_west = frame.to_geodetic({-kReach_m, -kReach_m});
  const Geodetic north_east = frame.to_geodetic({kReach_m, kReach_m});
  HeightGrid::Layout layout;
  layout.south_deg = south_west.latitude_deg;
  layout.west_deg = south_west.longitude_deg;
  layout.rows = layout.columns = static_cast<std::size_t>(std::ceil(2.0 * kReach_m / spacing_m)) + 1;
  const auto steps = static_cast<double>(layout.rows - 1);
  layout.latitude_step_deg = (north_east.latitude_deg - south_west.latitude_deg) / steps;
  layout.longitude_step_deg = (north_east.longitude_deg - south_west.longitude_deg) / steps;
  std::vector<float> heights_m;
  heights_m.reserve(layout.rows * layout.columns);
  for (std::size_t row = 0; row < layout.rows; ++row) {
    for (std::size_t column = 0; column < layout.columns; ++column) {
      const Geodetic node{layout.south_deg + static_cast<double>(row) * layout.latitude_step_deg,
                          layout.west_deg + static_cast<double>(column) * layout.longitude_step_deg};
      heights_m.push_back(
          static_cast<float>(home_msl_m + terrain.height_above_home_m(frame.to_local(node).position_in_enu)));
    }
  }
  return {layout, std::move(heights_m)};
}

std::string to_ascii_grid(const HeightGrid& model) {
  const HeightGrid::Layout& layout = model.layout();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(15) << "ncols " << layout.columns << "\nnrows " << layout.rows << "\nxllcenter "
       << layout.west_deg << "\nyllcenter " << layout.south_deg << "\ndx " << layout.longitude_step_deg
       << "\ndy " << layout.latitude_step_deg << "\n"
       << std::fixed << std::setprecision(3);
  for (std::size_t row = layout.rows; row-- > 0;) {
    for (std::size_t column = 0; column < layout.columns; ++column)
      text << (column > 0 ? " " : "") << model.node_m(row, column);
    text << "\n";
  }
  return text.str();
}

std::string wgs84_prj() {
  return "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],"
         "PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]]\n";
}

}  // namespace geoloc::sim
