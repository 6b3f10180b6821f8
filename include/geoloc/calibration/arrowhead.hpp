// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/calibration/drift.hpp"
#include "geoloc/calibration/envelope_cholesky.hpp"
#include "geoloc/calibration/landmark.hpp"

namespace geoloc {

/// Least squares over everything seen so far: calibration and drift (the head) and all objects (the arrow's
/// shaft), which are eliminated one by one because no look joins two of them. Exact up to linearisation.
class ArrowheadSolver {
 public:
  /// For at most so many nodes; sigma_offset_m: of the vehicle's constant position error, an axis.
  ArrowheadSolver(const CalibrationPrior& prior, int max_nodes);

  /// Solves for the head with the objects' sums. Sets the nodes' means and the calibration. False, and
  /// nothing is set, where rounding has left no solution.
  bool solve(const std::vector<const Landmark*>& landmarks, double sigma_offset_m, DriftTimeline& drift,
             Calibration& calibration);

  /// Covariance of the newest node after solve().
  const NodeMatrix& newest_node_covariance() const { return newest_node_covariance_; }

  /// How strongly the position was seen to wander, in units of what the nodes' prior says: one step of
  /// expectation maximisation after solve(). nullopt while there are too few nodes to tell. Costs as much as
  /// a solution.
  std::optional<double> observed_wandering(const DriftTimeline& drift);

  /// Of an object's absolute position after solve(): its own noise and that of the head.
  Eigen::Matrix2d covariance(const Landmark& landmark, const DriftTimeline& drift) const;

  /// Of the difference of two objects' positions after solve(): what they share cancels.
  Eigen::Matrix2d covariance_of_difference(const Landmark& a, const Landmark& b,
                                           const DriftTimeline& drift) const;

  /// The prior's mean and information.
  CalibrationVector prior_mean() const { return prior_mean_; }
  CalibrationVector prior_sigma(double sigma_offset_m) const;

 private:
  void add_prior(double sigma_offset_m, const DriftTimeline& drift);
  void add_landmark(const Landmark& landmark, const DriftTimeline& drift);
  void add_gain(const Landmark& landmark, const DriftTimeline& drift, double sign) const;
  Eigen::Matrix2d head_covariance(Eigen::Index first) const;

  CalibrationVector prior_mean_;
  CalibrationVector prior_sigma_;  // of all but the offset
  EnvelopeCholesky information_;   // S, and its factor after solve()
  Eigen::VectorXd right_hand_side_;
  mutable EnvelopeCholesky::TwoColumns gains_;  // scratch: dx/d(head), transposed
  NodeMatrix newest_node_covariance_ = NodeMatrix::Zero();
};

}  // namespace geoloc
