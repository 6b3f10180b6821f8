// SPDX-License-Identifier: Apache-2.0
// What follows from the head that was found (ArrowheadSolver::Solution).
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/arrowhead.hpp"

namespace geoloc {
namespace {

/// Where the head's part begins that concerns the object: at the oldest node that it was seen at.
Eigen::Index first_column(const Landmark& landmark, const HeadLayout& layout) {
  if (!landmark.spells().is_empty()) return layout.column_of_spell(landmark.spells().begin()->number);
  return landmark.begin() == landmark.end() ? layout.column_of_calibration()
                                            : layout.column_of(landmark.begin()->number);
}

}  // namespace

ArrowheadSolver::Solution::Solution(ArrowheadSolver& solver, const HeadLayout& layout)
    : solver_(&solver),
      layout_(layout),
      newest_covariance_(solver.information_.last_of_inverse<kNodeSize + CalibrationIndex::kSize>()) {}

Calibration ArrowheadSolver::Solution::calibration() const {
  return {solver_->right_hand_side_.segment<CalibrationIndex::kSize>(layout_.column_of_calibration()),
          newest_covariance_.bottomRightCorner<CalibrationIndex::kSize, CalibrationIndex::kSize>()};
}

NodeVector ArrowheadSolver::Solution::node(std::uint32_t number) const {
  return solver_->right_hand_side_.segment<kNodeSize>(layout_.column_of(number));
}

SwayVector ArrowheadSolver::Solution::spell(std::uint32_t number) const {
  return solver_->right_hand_side_.segment<kSwaySize>(layout_.column_of_spell(number));
}

NodeMatrix ArrowheadSolver::Solution::newest_node_covariance() const {
  return newest_covariance_.topLeftCorner<kNodeSize, kNodeSize>();
}

std::optional<WanderingScales> ArrowheadSolver::Solution::observed_wandering(
    const DriftTimeline& drift) const {
  constexpr int kEnoughNodes = 8;
  if (drift.size() < kEnoughNodes) return std::nullopt;
  find_node_rows();
  PositionPrior& prior = solver_->position_prior_;
  PositionPrior::Excess sum;
  for (int component = 0; component < 2; ++component) {
    prior.form(drift, component);
    find_moments(drift, component);
    const PositionPrior::Excess excess = prior.excess(solver_->moments_);
    sum.of_wandering += excess.of_wandering;
    sum.of_ripple += excess.of_ripple;
  }
  const double count = 2.0 * drift.size();
  return WanderingScales{drift.position_scale() * std::sqrt(1.0 + sum.of_wandering / count),
                         drift.ripple_scale() * std::sqrt(1.0 + sum.of_ripple / count)};
}

/// Rows e' L^-T of S^-1 = L^-T L^-1, for e the nodes' east and north by turns: their products are
/// covariances.
void ArrowheadSolver::Solution::find_node_rows() const {
  const Eigen::Index rows = 2 * static_cast<Eigen::Index>(layout_.end - layout_.begin);
  const auto column_of_row = [&](Eigen::Index row) {
    return layout_.column_of(layout_.begin) + kNodeSize * (row / 2) + row % 2;
  };
  EnvelopeCholesky::Rows& units = solver_->sensitivities_;
  for (Eigen::Index row = 0; row < rows; row += kPointSize) {
    const Eigen::Index count = std::min<Eigen::Index>(kPointSize, rows - row);
    units.leftCols(layout_.size()).setZero();
    for (Eigen::Index k = 0; k < count; ++k) units(k, column_of_row(row + k)) = 1.0;
    solver_->information_.solve_lower(units, column_of_row(row));
    solver_->node_rows_.block(row, 0, count, layout_.size()) = units.topLeftCorner(count, layout_.size());
  }
}

/// Of the nodes' east or north about what the prior expects.
void ArrowheadSolver::Solution::find_moments(const DriftTimeline& drift, int component) const {
  const PositionPrior& prior = solver_->position_prior_;
  const auto off_m = [&](Eigen::Index node) {
    return drift.node(layout_.begin + static_cast<std::uint32_t>(node)).mean[component] - prior.mean(node);
  };
  for (Eigen::Index i = 0; i < prior.size(); ++i) {
    const auto row = solver_->node_rows_.row(2 * i + component).head(layout_.size());
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto other = solver_->node_rows_.row(2 * j + component).head(layout_.size());
      solver_->moments_(i, j) = solver_->moments_(j, i) = row.dot(other) + off_m(i) * off_m(j);
    }
  }
}

void ArrowheadSolver::add_sensitivity(const Landmark& landmark, const HeadLayout& layout, double sign) {
  const PointMatrix A_inverse = sign * landmark.A().inverse();
  sensitivities_.middleCols<CalibrationIndex::kSize>(layout.column_of_calibration()) +=
      A_inverse * landmark.B();
  for (const Landmark::NodeTerms& terms : landmark)
    sensitivities_.middleCols<kNodeSize>(layout.column_of(terms.number)) += A_inverse * terms.B;
  for (const Landmark::SpellTerms& terms : landmark.spells())
    sensitivities_.middleCols<kSwaySize>(layout.column_of_spell(terms.number)) += A_inverse * terms.B;
}

/// G S^-1 G' of the sensitivities gathered, which are zero before `first`.
PointMatrix ArrowheadSolver::head_covariance(Eigen::Index first) {
  information_.solve_lower(sensitivities_, first);
  const auto used = sensitivities_.middleCols(first, information_.size() - first);
  return used.lazyProduct(used.transpose());
}

PointMatrix ArrowheadSolver::Solution::covariance(const Landmark& landmark) const {
  solver_->sensitivities_.leftCols(layout_.size()).setZero();
  solver_->add_sensitivity(landmark, layout_, 1.0);
  solver_->sensitivities_(2, layout_.column_of_calibration() + CalibrationIndex::kHeight) -= 1.0;
  return landmark.A().inverse() + solver_->head_covariance(first_column(landmark, layout_));
}

PointMatrix ArrowheadSolver::Solution::covariance_of_difference(const Landmark& a, const Landmark& b) const {
  solver_->sensitivities_.leftCols(layout_.size()).setZero();
  solver_->add_sensitivity(a, layout_, 1.0);
  solver_->add_sensitivity(b, layout_, -1.0);
  return a.A().inverse() + b.A().inverse() +
         solver_->head_covariance(std::min(first_column(a, layout_), first_column(b, layout_)));
}

}  // namespace geoloc
