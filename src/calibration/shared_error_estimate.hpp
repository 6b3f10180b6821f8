// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "calibration/arrowhead.hpp"
#include "calibration/drift.hpp"
#include "calibration/height_prior.hpp"
#include "calibration/noise_estimate.hpp"
#include "calibration/shared_error.hpp"
#include "geoloc/calibration/calibration.hpp"

namespace geoloc {

/// How the horizontal accuracy that the vehicle reports (radial, 1-sigma), or that is assumed of it, divides
/// among the errors of its position.
struct PositionAccuracy {
  double radial_m;
  double constant_share;  ///< share of the variance that stays constant over a flight; the rest wanders
  /// Least 1-sigma of the constant error, per axis: before the flight shows how much the position wanders (an
  /// RTK fix states centimetres against its base, and nothing of where that stands), and whatever it shows.
  double stated_offset_sigma_m;
  double least_offset_sigma_m;
  bool is_reported = false;  ///< the radial one, by the vehicle; else it is assumed

  /// What the vehicle says of itself from now on.
  void report(double reported_radial_m);

  /// The part of it that may change within minutes: whatever a receiver says of itself, an autopilot's
  /// position does not wander by tens of metres and stay usable.
  double changing_m() const { return std::min(radial_m, kMostChanging_m); }

  /// 1-sigma per axis of the wandering.
  double wandering_sigma_m() const;

  /// 1-sigma per axis of the constant error. A receiver that wanders less than it reports (`wandering_scale`
  /// below 1) is taken to be as much better in what no look can show.
  double offset_sigma_m(double wandering_scale) const;

  /// How strongly the position is taken to wander, of what was expected, where it was observed to do so by
  /// `observed`. What a vehicle reports is believed to be wrong by some factor at most; what was assumed may
  /// be as small as the least that any vehicle is believed to report.
  double believed_scale(double observed) const;

 private:
  static constexpr double kMostChanging_m = 3.0;
  static constexpr double kLeastReported_m = 0.02, kMostReported_m = 100.0;
  static constexpr double kLeastScale = 0.1, kMostScale = 3.0;
};

/// What is known by now of the errors that looks share: the camera's and the vehicle's constant ones, and the
/// drift of the vehicle's state.
struct SharedErrorEstimate {
  PositionAccuracy accuracy;
  DriftTimeline drift;
  HeightPrior height_prior;
  NoiseEstimate noise;
  bool is_opening = true;                     ///< these are the flight's first looks
  std::optional<LatencyPrior> latency_prior;  ///< since a clock stepped
  Calibration calibration;
  /// Roots of the covariances, C = R R', of calibration and newest node: they whiten Jacobians.
  SharedError::CalibrationMatrix calibration_root;
  NodeMatrix drift_root;

  /// Before anything was seen.
  SharedErrorEstimate(const PositionAccuracy& reported, const HeightPrior& height_prior,
                      const NoiseEstimate& noise, const DriftConfig& drift_config,
                      const ArrowheadSolver& solver);

  double offset_sigma_m() const { return accuracy.offset_sigma_m(drift.position_scale()); }

  /// Takes the sway to be as strong as the noise of the frames. While the flight opens it is a tenth of that,
  /// since the looks bear it all. Noise that does not last from one frame to the next is no sway. Where the
  /// focal length is an unknown, what the position ripples by between the nodes is added: it would be taken
  /// for tilts, by which the image shows the focal length.
  void believe_in_sway(double expected_position_variance_m2, bool noise_lasts);

  /// For the next solution.
  FlightPrior prior() const {
    return {height_prior.mean_m, height_prior.sigma_at(calibration.height_m()), offset_sigma_m(),
            latency_prior};
  }

  /// By how much a camera is to be lifted that reports to be so high above the level ground [m].
  double lift_m(double reported_height_above_ground_m) const;

  /// Limits how far association takes the height to be unknown, to a share of the height itself: the camera
  /// is above the ground. (Were it not, all looks could be looks at one object.) The next solution undoes it.
  void bound_height(double height_above_ground_m);

  /// The vehicle's state has stepped: until the next solution its drift is less well known.
  void widen_drift(const NodeVector& step_variance);

  /// The latency is another from now on, `latency_s` to about `sigma_s`; what was seen so far says nothing of
  /// it.
  void begin_latency(const LatencyPrior& latency);

  /// Everything but the wandering's scale.
  void take(const ArrowheadSolver::Solution& solution);

  /// Heights above the level ground to heights above home, which the calibration's height tells apart.
  SharedError::PointRow above_home(SharedError::PointRow sensitivity) const {
    sensitivity.row(2).segment<SharedError::kCalibrationSize>(SharedError::kCalibration) -=
        calibration_root.row(CalibrationIndex::kHeight);
    return sensitivity;
  }

  /// With C = R R', J C J' is the square of J R: cheap for every pair of look and track.
  template <int Rows>
  Eigen::Matrix<double, Rows, SharedError::kSize> whitened(
      const Eigen::Matrix<double, Rows, SharedError::kCalibrationSize>& by_calibration,
      const Eigen::Matrix<double, Rows, kNodeSize>& by_drift) const {
    Eigen::Matrix<double, Rows, SharedError::kSize> rows =
        Eigen::Matrix<double, Rows, SharedError::kSize>::Zero();
    rows.template middleCols<SharedError::kCalibrationSize>(SharedError::kCalibration) =
        by_calibration * calibration_root;
    rows.template middleCols<kNodeSize>(SharedError::kDrift) = by_drift * drift_root;
    return rows;
  }
};

}  // namespace geoloc
