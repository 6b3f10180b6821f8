// SPDX-License-Identifier: Apache-2.0
#include "calibration/position_prior.hpp"

#include <cmath>
#include <cstdint>

namespace geoloc {

PositionPrior::PositionPrior(Eigen::Index max_nodes) : mean_(Eigen::VectorXd::Zero(max_nodes)) {
  for (Matrix* const matrix : {&wandering_, &ripple_, &root_, &whitening_, &information_, &scratch_})
    matrix->setZero(max_nodes, max_nodes);
}

void PositionPrior::form(const DriftTimeline& drift, int component) {
  size_ = drift.size();
  set_covariance(drift, component);
  invert();
}

/// A process' covariance with a later node is its variance here, times the transitions until then. What a
/// step adds wanders on.
void PositionPrior::set_covariance(const DriftTimeline& drift, int component) {
  const auto node = [&](Eigen::Index i) -> const DriftNode& {
    return drift.node(drift.begin() + static_cast<std::uint32_t>(i));
  };
  double mean = 0.0, wandering = 0.0, ripple = 0.0, step = 0.0;  // of the node before; variances
  for (Eigen::Index i = 0; i < size_; ++i) {
    const double kept = node(i).transition[component], kept_ripple = node(i).ripple_transition;
    const auto number = drift.begin() + static_cast<std::uint32_t>(i);
    mean = node(i).prior_mean[component] + kept * mean;
    wandering = kept * kept * wandering + drift.wandering_variance(number, component);
    ripple = kept_ripple * kept_ripple * ripple + drift.ripple_variance(number);
    step = kept * kept * step + node(i).step_variance[component];
    mean_[i] = mean;
    double until = 1.0, until_of_ripple = 1.0;
    for (Eigen::Index j = i; j < size_; ++j) {
      if (j > i) {
        until *= node(j).transition[component];
        until_of_ripple *= node(j).ripple_transition;
      }
      wandering_(i, j) = wandering_(j, i) = until * wandering;
      ripple_(i, j) = ripple_(j, i) = until_of_ripple * ripple;
      root_(j, i) = wandering_(j, i) + ripple_(j, i) + until * step;
    }
  }
}

void PositionPrior::invert() {
  for (Eigen::Index i = 0; i < size_; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      root_(i, j) = (root_(i, j) - root_.row(i).head(j).dot(root_.row(j).head(j))) / root_(j, j);
    root_(i, i) = std::sqrt(root_(i, i) - root_.row(i).head(i).squaredNorm());
    auto row = whitening_.row(i).head(size_);
    row.setZero();
    for (Eigen::Index j = 0; j < i; ++j) row.head(j + 1) -= root_(i, j) * whitening_.row(j).head(j + 1);
    row[i] = 1.0;
    row /= root_(i, i);
  }
  const auto whitening = whitening_.topLeftCorner(size_, size_);
  information_.topLeftCorner(size_, size_) = whitening.transpose().lazyProduct(whitening);
}

/// With K the covariance, of which S is a part, and M the moments: tr(S (K^-1 M K^-1 - K^-1)).
PositionPrior::Excess PositionPrior::excess(const Matrix& moments) {
  const auto information = information_.topLeftCorner(size_, size_);
  auto weighted = scratch_.topLeftCorner(size_, size_);
  weighted = information.lazyProduct(moments.topLeftCorner(size_, size_));
  Excess excess;
  for (Eigen::Index i = 0; i < size_; ++i) {
    for (Eigen::Index j = 0; j < size_; ++j) {
      const double more = weighted.row(i).dot(information.row(j)) - information(i, j);
      excess.of_wandering += wandering_(i, j) * more;
      excess.of_ripple += ripple_(i, j) * more;
    }
  }
  return excess;
}

}  // namespace geoloc
