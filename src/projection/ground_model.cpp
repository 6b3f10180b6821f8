// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/ground_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geoloc {
namespace {

/// Where a grid has no height, and at most beyond its edge. More, and the first looks from a low flight could
/// be looks at anything below it.
constexpr double kUnknownSigma_m = 10.0;
/// Beyond its edge: so steep may the ground be.
constexpr double kSlopeBeyond = 0.2;
constexpr int kMostSteps = 4096;
/// Halvings of a step: to a micrometre from anything that is stepped by.
constexpr int kRefinements = 40;
constexpr double kCloseEnough_m = 1e-6;

}  // namespace

GroundModel::GroundModel(std::shared_ptr<const HeightGrid> grid, const LocalFrame& frame, double sigma_m)
    : sigma_m_(sigma_m), grid_(std::move(grid)), frame_(frame) {
  if (!grid_) return;
  const auto at_origin = grid_at(Eigen::Vector2d::Zero());
  height_at_origin_m_ = at_origin ? at_origin->height_m : 0.5 * (grid_->least_m() + grid_->greatest_m());
  least_m_ = std::min(0.0, grid_->least_m() - height_at_origin_m_);
  greatest_m_ = std::max(0.0, grid_->greatest_m() - height_at_origin_m_);
}

std::optional<HeightGrid::Height> GroundModel::grid_at(const Eigen::Vector2d& position_in_enu) const {
  return grid_->at(frame_->to_geodetic(position_in_enu));
}

double GroundModel::height_m(const Eigen::Vector2d& position_in_enu) const {
  if (is_level()) return 0.0;
  const auto here = grid_at(position_in_enu);
  return here ? here->height_m - height_at_origin_m_ : 0.0;
}

/// The slope is that of the grid's cell: a difference over a longer way would round its edges off.
GroundAt GroundModel::at(const Eigen::Vector2d& position_in_enu) const {
  if (is_level()) return {0.0, Eigen::Vector2d::Zero(), sigma_m_};
  const auto here = grid_at(position_in_enu);
  if (!here) return {0.0, Eigen::Vector2d::Zero(), std::max(sigma_m_, kUnknownSigma_m)};
  const double step_m = 1e-3 * grid_->spacing_m();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    const auto beside = grid_at(position_in_enu + step_m * Eigen::Vector2d::Unit(axis));
    if (beside) slope[axis] = (beside->height_m - here->height_m) / step_m;
  }
  const double beyond_sigma_m = std::min(kSlopeBeyond * here->beyond_m, kUnknownSigma_m);
  return {here->height_m - height_at_origin_m_, slope, std::hypot(sigma_m_, beyond_sigma_m)};
}

double GroundModel::spacing_m() const {
  return is_level() ? std::numeric_limits<double>::infinity() : grid_->spacing_m();
}

std::optional<double> intersect(const Ray<double>& ray, const GroundModel& ground, double max_range_m) {
  const auto clearance_m = [&](double range_m) {
    const Eigen::Vector3d point = ray.at(range_m);
    return point.z() - ground.height_m(point.head<2>());
  };
  const double fall = -ray.direction.z();  // per metre of range
  if (!ray.origin.allFinite() || !(fall > 0.0) || !(clearance_m(0.0) > 0.0)) return std::nullopt;
  double above_m = std::max(0.0, (ray.origin.z() - ground.greatest_m()) / fall);
  const double lowest_m = (ray.origin.z() - ground.least_m()) / fall;  // the ground is met until there
  const double end_m = std::min(max_range_m, lowest_m);
  if (!(above_m <= end_m) || !std::isfinite(end_m)) return std::nullopt;

  const double across = std::max(ray.direction.head<2>().norm(), 1e-6);
  const double step_m = std::max(0.5 * ground.spacing_m() / across, (end_m - above_m) / kMostSteps);
  double below_m = above_m;
  while (clearance_m(below_m) > 0.0) {
    if (!(below_m < end_m)) return end_m < lowest_m ? std::nullopt : std::optional(lowest_m);
    above_m = below_m;
    below_m = std::min(below_m + step_m, end_m);
  }
  for (int i = 0; i < kRefinements && below_m - above_m > kCloseEnough_m; ++i) {
    const double middle_m = 0.5 * (above_m + below_m);
    (clearance_m(middle_m) > 0.0 ? above_m : below_m) = middle_m;
  }
  return 0.5 * (above_m + below_m);
}

}  // namespace geoloc
