// SPDX-License-Identifier: Apache-2.0
#include "tracking/ground_prior.hpp"

#include <algorithm>

namespace geoloc {
namespace {

/// Stands for "exactly known": keeps the information finite.
constexpr double kLeastSigma_m = 1e-3;

}  // namespace

PointInformation ground_prior(const GroundModel& ground, const Eigen::Vector2d& place, double least_sigma_m) {
  const GroundAt here = ground.at(place);
  const double sigma_m = std::max({here.sigma_m, least_sigma_m, kLeastSigma_m});
  const Point row(-here.slope.x(), -here.slope.y(), 1.0);
  const double value_m = here.height_m - here.slope.dot(place);
  PointInformation information;
  information.matrix = row * row.transpose() / (sigma_m * sigma_m);
  information.vector = row * value_m / (sigma_m * sigma_m);
  return information;
}

Point ground_point(const Look& look, const GroundModel& ground, double max_range_m) {
  const Eigen::Vector2d& slope = look.observation.slope;
  const Point at_look(look.position.x(), look.position.y(), look.terrain_m);
  const Point down = -Point(slope.x(), slope.y(), 1.0);
  const Ray<double> ray{at_look - look.camera_height_m * down, down.normalized()};
  if (const auto range_m = intersect(ray, ground, max_range_m)) return ray.at(*range_m);
  return {look.position.x(), look.position.y(), ground.height_m(look.position)};
}

void place_on_ground(std::vector<Look>& looks, const GroundModel& ground, double max_range_m) {
  if (ground.is_level()) return;
  for (Look& look : looks) place_at_height(look, ground_point(look, ground, max_range_m).z());
}

void place_at_height(Look& look, double height_m) {
  const double rise_m = height_m - look.terrain_m;
  look.position += look.observation.slope * rise_m;
  look.camera_height_m -= rise_m;
  look.terrain_m = height_m;
}

}  // namespace geoloc
