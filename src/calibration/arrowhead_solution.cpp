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

SwayVector ArrowheadSolver::Solution::spell_per_focal(std::uint32_t number) const {
  if (!solver_->is_focal_unknown()) return SwayVector::Zero();
  const Eigen::VectorXd& covariances = solver_->covariances_of_focal_;
  return covariances.segment<kSwaySize>(layout_.column_of_spell(number)) /
         covariances[layout_.column_of_calibration() + CalibrationIndex::kFocal];
}

NodeMatrix ArrowheadSolver::Solution::newest_node_covariance() const {
  return newest_covariance_.topLeftCorner<kNodeSize, kNodeSize>();
}

std::optional<double> ArrowheadSolver::Solution::observed_wandering(const DriftTimeline& drift) const {
  constexpr int kEnoughNodes = 8;
  if (drift.size() < kEnoughNodes) return std::nullopt;
  int count = 0;
  for (std::uint32_t number = layout_.begin + 1; number != layout_.end; ++number)
    count += drift.node(number).is_after_step() ? 0 : 2;
  if (count == 0) return std::nullopt;
  const double sum = sum_of_steps(drift, 0) + sum_of_steps(drift, 1);
  return drift.position_scale() * std::sqrt(sum / count);
}

/// Expected squares of what the nodes' east or north differs by from what those before let expect, in units
/// of the prior's variances. Three nodes at a time.
double ArrowheadSolver::Solution::sum_of_steps(const DriftTimeline& drift, int component) const {
  PositionPrior& prior = solver_->position_prior_;
  prior.form(drift, component);
  EnvelopeCholesky::Rows& steps = solver_->sensitivities_;
  const Eigen::Index first = layout_.column_of(layout_.begin);
  const auto number = [&](Eigen::Index node) { return layout_.begin + static_cast<std::uint32_t>(node); };
  double sum = 0.0;
  for (Eigen::Index begin = 1; begin < prior.size(); begin += kPointSize) {
    steps.leftCols(layout_.size()).setZero();
    Point means = Point::Zero();
    for (Eigen::Index k = 0; k < kPointSize && begin + k < prior.size(); ++k) {
      if (drift.node(number(begin + k)).is_after_step()) continue;
      for (Eigen::Index node = 0; node <= begin + k; ++node) {
        const double weight = prior.whitening(begin + k, node);
        means[k] += weight * (drift.node(number(node)).mean[component] - prior.mean(node));
        steps(k, first + kNodeSize * node + component) = weight;
      }
    }
    solver_->information_.solve_lower(steps, first);
    sum += means.squaredNorm() + steps.leftCols(layout_.size()).squaredNorm();
  }
  return sum;
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

/// The sensitivity of an object's position to the head, its height that above the reported home.
void ArrowheadSolver::Solution::gather_sensitivity(const Landmark& landmark) const {
  solver_->sensitivities_.leftCols(layout_.size()).setZero();
  solver_->add_sensitivity(landmark, layout_, 1.0);
  solver_->sensitivities_(2, layout_.column_of_calibration() + CalibrationIndex::kHeight) -= 1.0;
}

EnvelopeCholesky::Rows ArrowheadSolver::Solution::shared_error(const Landmark& landmark) const {
  gather_sensitivity(landmark);
  solver_->information_.solve_lower(solver_->sensitivities_, first_column(landmark, layout_));
  return solver_->sensitivities_.leftCols(layout_.size());
}

Eigen::RowVectorXd ArrowheadSolver::Solution::shared_error_of(Eigen::Index column) const {
  solver_->sensitivities_.leftCols(layout_.size()).setZero();
  solver_->sensitivities_(0, column) = 1.0;
  solver_->information_.solve_lower(solver_->sensitivities_, column);
  return solver_->sensitivities_.row(0).head(layout_.size());
}

Eigen::RowVectorXd ArrowheadSolver::Solution::shared_error_of_calibration(int index) const {
  return shared_error_of(layout_.column_of_calibration() + index);
}

Eigen::RowVectorXd ArrowheadSolver::Solution::shared_error_of_node(std::uint32_t number,
                                                                   int component) const {
  return shared_error_of(layout_.column_of(number) + component);
}

PointMatrix ArrowheadSolver::Solution::covariance(const Landmark& landmark) const {
  gather_sensitivity(landmark);
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
