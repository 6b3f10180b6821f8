// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "calibration/drift.hpp"

namespace geoloc {

/// What is expected of the nodes' east or north: the sum of two Gauss-Markov processes, wandering and ripple,
/// which is none itself. So each node depends on all the others, and the information is a full matrix. Never
/// allocates after construction.
class PositionPrior {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit PositionPrior(Eigen::Index max_nodes);
  /// geometry/room.hpp
  static std::size_t take_room(PositionPrior* self, Eigen::Index max_nodes);

  /// Forms the prior of component 0 (east) or 1 (north), for the nodes that are estimated. What was formed
  /// last is kept where the covariance is the same, as it mostly is for both components and from one solution
  /// to the next.
  void form(const DriftTimeline& drift, int component);

  Eigen::Index size() const { return size_; }
  double mean(Eigen::Index node) const { return mean_[node]; }

  /// An element of the inverse covariance [1/m^2]: of the lower triangle.
  double information(Eigen::Index row, Eigen::Index column) const { return information_(row, column); }

  /// W = L^-1, where L L' is the covariance: row i tells in sigmas by how much node i differs from what those
  /// before it let expect. The lower triangle.
  double whitening(Eigen::Index row, Eigen::Index column) const { return whitening_(row, column); }

 private:
  bool set_covariance(const DriftTimeline& drift, int component);
  void invert();

  Eigen::Index size_ = 0;
  Eigen::VectorXd mean_;
  Matrix covariance_;  // the lower triangle
  Matrix root_;        // L
  Matrix whitening_;
  Matrix information_;
};

}  // namespace geoloc
