// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "geoloc/projection/height_grid.hpp"

namespace geoloc::testing {

/// A grid of that height by east and north of the frame's origin [m], 400 m wide.
inline std::shared_ptr<const HeightGrid> grid_of(
    const LocalFrame& frame, const std::function<double(const Eigen::Vector2d&)>& height_m,
    double spacing_m = 2.0) {
  const Geodetic south_west = frame.to_geodetic({-200.0, -200.0});
  const Geodetic north_east = frame.to_geodetic({200.0, 200.0});
  HeightGrid::Layout layout;
  layout.rows = layout.columns = static_cast<std::size_t>(400.0 / spacing_m) + 1;
  layout.south_deg = south_west.latitude_deg;
  layout.west_deg = south_west.longitude_deg;
  const auto steps = static_cast<double>(layout.rows - 1);
  layout.latitude_step_deg = (north_east.latitude_deg - south_west.latitude_deg) / steps;
  layout.longitude_step_deg = (north_east.longitude_deg - south_west.longitude_deg) / steps;
  std::vector<float> heights_m;
  for (std::size_t row = 0; row < layout.rows; ++row) {
    for (std::size_t column = 0; column < layout.columns; ++column) {
      const Geodetic node{layout.south_deg + static_cast<double>(row) * layout.latitude_step_deg,
                          layout.west_deg + static_cast<double>(column) * layout.longitude_step_deg};
      heights_m.push_back(static_cast<float>(height_m(frame.to_local(node).position_in_enu)));
    }
  }
  return std::make_shared<const HeightGrid>(layout, std::move(heights_m));
}

/// A plane that rises by `slope` per metre, 700 m above anything at the origin.
inline std::shared_ptr<const HeightGrid> tilted_ground(const LocalFrame& frame,
                                                       const Eigen::Vector2d& slope) {
  return grid_of(frame, [=](const Eigen::Vector2d& place) { return 700.0 + slope.dot(place); });
}

}  // namespace geoloc::testing
