// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calibration/arrowhead.hpp"
#include "calibration/drift.hpp"
#include "calibration/shared_error.hpp"
#include "geoloc/calibration/calibration.hpp"

namespace geoloc {

/// How the horizontal accuracy that the vehicle reports (radial, 1-sigma) divides among the errors of its
/// position.
struct PositionAccuracy {
  double radial_m;
  double constant_share;        ///< share of the variance that stays constant over a flight; the rest wanders
  double least_offset_sigma_m;  ///< of the constant error, per axis

  /// 1-sigma per axis of the wandering.
  double wandering_sigma_m() const;

  /// 1-sigma per axis of the constant error. A receiver that wanders less than it reports (`wandering_scale`
  /// below 1) is taken to be as much better in what no look can show.
  double offset_sigma_m(double wandering_scale) const;
};

/// What is known by now of the errors that looks share: the camera's and the vehicle's constant ones, and the
/// drift of the vehicle's state.
struct SharedErrorEstimate {
  PositionAccuracy accuracy;
  DriftTimeline drift;
  Calibration calibration;
  /// Roots of the covariances, C = R R', of calibration and newest node: they whiten Jacobians.
  SharedError::CalibrationMatrix calibration_root;
  NodeMatrix drift_root;

  /// Before anything was seen.
  SharedErrorEstimate(const PositionAccuracy& reported, const DriftConfig& drift_config,
                      const ArrowheadSolver& solver);

  double offset_sigma_m() const { return accuracy.offset_sigma_m(drift.position_scale()); }

  /// Everything but the wandering's scale.
  void take(const ArrowheadSolver::Solution& solution);

  /// With C = R R', J C J' is the square of J R: cheap for every pair of look and track.
  SharedError::Row whitened(const SharedError::CalibrationRow& by_calibration,
                            const Eigen::Matrix<double, 2, kNodeSize>& by_drift) const;
};

}  // namespace geoloc
