// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calibration/drift.hpp"

namespace geoloc {

/// What is expected of the nodes' east or north: the sum of two Gauss-Markov processes, wandering and ripple,
/// which is none itself. So each node depends on all the others, and the information is a full matrix. Never
/// allocates after construction.
class PositionPrior {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit PositionPrior(Eigen::Index max_nodes);

  /// Of component 0 (east) or 1 (north), for the nodes that are estimated.
  void form(const DriftTimeline& drift, int component);

  Eigen::Index size() const { return size_; }
  double mean(Eigen::Index node) const { return mean_[node]; }

  /// Of the inverse covariance [1/m^2].
  double information(Eigen::Index row, Eigen::Index column) const { return information_(row, column); }

  /// Sums over the nodes, in units of the variances that are expected.
  struct Excess {
    double of_wandering = 0.0;
    double of_ripple = 0.0;
  };

  /// By how much more the two were seen to vary than expected. `moments`: of the nodes about mean(), expected
  /// given all that was seen [m^2], size() rows and columns. Expectation maximisation multiplies a variance
  /// by 1 + excess / number of nodes.
  Excess excess(const Matrix& moments);

 private:
  void set_covariance(const DriftTimeline& drift, int component);
  void invert();

  Eigen::Index size_ = 0;
  Eigen::VectorXd mean_;
  Matrix wandering_, ripple_;  // covariances, without steps
  Matrix root_;                // of the whole covariance, its lower triangle; then Cholesky's factor L
  Matrix whitening_;           // L^-1
  Matrix information_;
  Matrix scratch_;
};

}  // namespace geoloc
