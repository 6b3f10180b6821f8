// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc {

/// The ground's height at the nodes of a grid in latitude and longitude (WGS84), above any level that is the
/// same everywhere. Between the nodes it is bilinear.
class HeightGrid {
 public:
  /// Rows run from south to north, columns from west to east.
  struct Layout {
    double south_deg = 0.0;  ///< of the first row
    double west_deg = 0.0;   ///< of the first column
    double latitude_step_deg = 0.0;
    double longitude_step_deg = 0.0;
    std::size_t rows = 0;
    std::size_t columns = 0;
  };

  /// What the grid says of a place.
  struct Height {
    double height_m = 0.0;
    double beyond_m = 0.0;  ///< so far outside the grid: the height is that of the edge's nearest place
  };

  /// `heights_m`: row by row; not a number where the height is not known. Refuses (refuse.hpp) a layout that
  /// is no grid on Earth, another number of heights, infinite ones, and where none is known: problems().
  HeightGrid(const Layout& layout, std::vector<float> heights_m);

  /// Everything that keeps these from being a grid.
  static std::vector<std::string> problems(const Layout& layout, const std::vector<float>& heights_m);

  /// nullopt where one of the four nodes around the place has no height.
  std::optional<Height> at(const Geodetic& place) const;

  double least_m() const { return least_m_; }
  double greatest_m() const { return greatest_m_; }

  /// Between neighbouring nodes, the shorter of the two sides.
  double spacing_m() const { return spacing_m_; }

  const Layout& layout() const { return layout_; }

  /// Not a number where it is not known.
  double node_m(std::size_t row, std::size_t column) const {
    return heights_m_[row * layout_.columns + column];
  }

 private:
  Layout layout_;
  std::vector<float> heights_m_;
  double least_m_ = 0.0;
  double greatest_m_ = 0.0;
  double spacing_m_ = 0.0;
};

}  // namespace geoloc
