// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/ray_plane.hpp"
#include "geoloc/projection/height_grid.hpp"

namespace geoloc {

/// What is known of the ground at a place.
struct GroundAt {
  double height_m = 0.0;                            ///< above the level ground
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< d height / d (east, north)
  double sigma_m = 0.0;                             ///< 1-sigma of the height of what stands there
};

/// Height of the ground about a level that is itself unknown (docs/method.md): level everywhere, or a grid's.
/// A grid's heights count from the one at the origin of the local frame, where the vehicle was first, so that
/// no datum enters. A value: copies share the grid.
class GroundModel {
 public:
  /// Level ground, and objects that stand so much above or below it.
  explicit GroundModel(double sigma_m) : sigma_m_(sigma_m) {}

  /// sigma_m: of objects about the grid's heights. Beyond its edge it grows, to 10 m, and where a height is
  /// missing the ground is level to 10 m.
  GroundModel(std::shared_ptr<const HeightGrid> grid, const LocalFrame& frame, double sigma_m);

  bool is_level() const { return grid_ == nullptr; }

  GroundAt at(const Eigen::Vector2d& position_in_enu) const;
  double height_m(const Eigen::Vector2d& position_in_enu) const;

  /// Bounds of the height, everywhere.
  double least_m() const { return least_m_; }
  double greatest_m() const { return greatest_m_; }

  /// Length over which the height may change; infinite where it is level.
  double spacing_m() const;

 private:
  std::optional<HeightGrid::Height> grid_at(const Eigen::Vector2d& position_in_enu) const;

  double sigma_m_;
  std::shared_ptr<const HeightGrid> grid_;
  std::optional<LocalFrame> frame_;
  double height_at_origin_m_ = 0.0;
  double least_m_ = 0.0;
  double greatest_m_ = 0.0;
};

/// Range [m] at which a ray first meets the ground, its origin's height counted from the level ground;
/// nullopt where it begins below the ground, does not meet it within max_range_m, or is not finite. It steps
/// along the ray by half of the grid's spacing, but not in more than 4096 steps: on longer ways ridges may be
/// missed.
std::optional<double> intersect(const Ray<double>& ray, const GroundModel& ground, double max_range_m);

}  // namespace geoloc
