// SPDX-License-Identifier: Apache-2.0
#include "calibration/position_prior.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "geometry/room.hpp"

namespace geoloc {

PositionPrior::PositionPrior(Eigen::Index max_nodes) {
  take_room(this, max_nodes);
  mean_.setZero();
  for (Matrix* const matrix : {&covariance_, &root_, &whitening_, &information_}) matrix->setZero();
}

std::size_t PositionPrior::take_room(PositionPrior* self, Eigen::Index max_nodes) {
  std::size_t bytes = room::resize(self, &PositionPrior::mean_, max_nodes);
  for (Matrix PositionPrior::*const matrix : {&PositionPrior::covariance_, &PositionPrior::root_,
                                              &PositionPrior::whitening_, &PositionPrior::information_})
    bytes += room::resize(self, matrix, max_nodes, max_nodes);
  return bytes;
}

void PositionPrior::form(const DriftTimeline& drift, int component) {
  const bool has_grown = std::exchange(size_, drift.size()) != drift.size();
  const bool has_changed = set_covariance(drift, component);
  if (has_grown || has_changed) invert();
}

/// A process' covariance with a later node is its variance here, times the transitions until then. False
/// where it is as before.
bool PositionPrior::set_covariance(const DriftTimeline& drift, int component) {
  const auto node = [&](Eigen::Index i) -> const DriftNode& {
    return drift.node(drift.begin() + static_cast<std::uint32_t>(i));
  };
  bool has_changed = false;
  const auto set = [&](double& element, double value) {
    has_changed = has_changed || element != value;
    element = value;
  };
  double mean = 0.0, wandering = 0.0, ripple = 0.0;  // of the node before; variances
  for (Eigen::Index i = 0; i < size_; ++i) {
    const auto number = drift.begin() + static_cast<std::uint32_t>(i);
    const double kept = node(i).transition[component], kept_ripple = node(i).ripple_transition;
    mean = node(i).prior_mean[component] + kept * mean;
    wandering = kept * kept * wandering + 1.0 / drift.information(number)[component];
    ripple = kept_ripple * kept_ripple * ripple + drift.ripple_variance(number);
    mean_[i] = mean;
    set(covariance_(i, i), wandering + ripple);
    double of_wandering = wandering, of_ripple = ripple;
    for (Eigen::Index j = i + 1; j < size_; ++j) {
      of_wandering *= node(j).transition[component];
      of_ripple *= node(j).ripple_transition;
      set(covariance_(j, i), of_wandering + of_ripple);
    }
  }
  return has_changed;
}

void PositionPrior::invert() {
  for (Eigen::Index i = 0; i < size_; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      root_(i, j) = (covariance_(i, j) - root_.row(i).head(j).dot(root_.row(j).head(j))) / root_(j, j);
    root_(i, i) = std::sqrt(covariance_(i, i) - root_.row(i).head(i).squaredNorm());
    auto row = whitening_.row(i).head(size_);
    row.setZero();
    for (Eigen::Index j = 0; j < i; ++j) row.head(j + 1) -= root_(i, j) * whitening_.row(j).head(j + 1);
    row[i] = 1.0;
    row /= root_(i, i);
  }
  information_.topLeftCorner(size_, size_).setZero();
  for (Eigen::Index k = 0; k < size_; ++k) {
    for (Eigen::Index i = 0; i <= k; ++i)
      information_.row(i).head(i + 1) += whitening_(k, i) * whitening_.row(k).head(i + 1);
  }
}

}  // namespace geoloc
