// SPDX-License-Identifier: Apache-2.0
#include "calibration/shared_error_estimate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// 1-sigma of the height that association allows for, of the height itself.
constexpr double kMostHeightShare = 0.05;
/// The camera is taken to be so high above the ground at least.
constexpr double kLeastHeightAboveGround_m = 0.5;
constexpr double kTiny = 1e-18;  // a variance for components that are exactly known

template <typename Matrix>
Matrix root_of(Matrix covariance) {
  covariance.diagonal().array() += kTiny;
  return Matrix(covariance.llt().matrixL());
}

SharedError::CalibrationMatrix root_of(const Calibration& calibration) {
  return root_of(SharedError::CalibrationMatrix(
      calibration.covariance.topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>()));
}

}  // namespace

void PositionAccuracy::report(double reported_radial_m) {
  radial_m = std::clamp(reported_radial_m, kLeastReported_m, kMostReported_m);
  is_reported = true;
}

double PositionAccuracy::wandering_sigma_m() const {
  return std::sqrt(0.5 * (1.0 - constant_share)) * changing_m();
}

double PositionAccuracy::offset_sigma_m(double wandering_scale) const {
  const double sigma_m = std::max(stated_offset_sigma_m, std::sqrt(0.5 * constant_share) * radial_m);
  return std::max(least_offset_sigma_m, wandering_scale * sigma_m);
}

double PositionAccuracy::believed_scale(double observed) const {
  const double least = is_reported ? kLeastScale : std::min(kLeastScale, kLeastReported_m / changing_m());
  return std::clamp(observed, least, kMostScale);
}

SharedErrorEstimate::SharedErrorEstimate(const PositionAccuracy& reported, const HeightPrior& expected_height,
                                         const NoiseEstimate& expected_noise, const DriftConfig& drift_config,
                                         const ArrowheadSolver& solver)
    : accuracy(reported),
      drift(drift_config),
      height_prior(expected_height),
      noise(expected_noise),
      calibration(solver.prior(
          {expected_height.mean_m, expected_height.sigma_at(expected_height.mean_m), offset_sigma_m()})),
      calibration_root(root_of(calibration)),
      drift_root(root_of(NodeMatrix(NodeMatrix::Zero()))) {}

void SharedErrorEstimate::believe_in_sway(double expected_position_variance_m2, bool noise_lasts) {
  constexpr double kShareOfOpening = 0.1;
  const double share = !noise_lasts ? 0.0 : is_opening ? kShareOfOpening : 1.0;
  const double ripple_m2 = calibration.has_unknown_focal() ? drift.ripple_between_nodes_m2() : 0.0;
  drift.sway().set_variance(share * (noise.position_factor() * expected_position_variance_m2 + ripple_m2),
                            share * noise.attitude_variance_rad2());
}

/// As estimated, but so that the camera stays above the ground while its height is not known: rays must meet
/// the ground somewhere, and where they do is linear in the height (LookMaker takes the difference).
double SharedErrorEstimate::lift_m(double reported_height_above_ground_m) const {
  const double height_m = calibration.height_m();
  const double prior_m = std::max(height_prior.sigma_at(height_m), 1e-9);
  const double unknown = calibration.sigma(CalibrationIndex::kHeight) / prior_m;
  const double least_m = std::max(kUsualHeight_m * unknown * unknown, kLeastHeightAboveGround_m);
  return std::max(height_m, least_m - reported_height_above_ground_m);
}

void SharedErrorEstimate::bound_height(double height_above_ground_m) {
  const double sigma_m = calibration.sigma(CalibrationIndex::kHeight);
  const double most_m = kMostHeightShare * std::abs(height_above_ground_m);
  calibration_root = root_of(calibration);
  if (sigma_m > most_m) calibration_root.row(CalibrationIndex::kHeight) *= most_m / sigma_m;
}

void SharedErrorEstimate::widen_drift(const NodeVector& step_variance) {
  NodeMatrix covariance = drift_root * drift_root.transpose();
  covariance.diagonal() += step_variance;
  drift_root = root_of(covariance);
}

void SharedErrorEstimate::begin_latency(const LatencyPrior& latency) {
  constexpr int kLatency = CalibrationIndex::kLatency;
  latency_prior = latency;
  calibration.mean[kLatency] = latency.latency_s;
  calibration.covariance.row(kLatency).setZero();
  calibration.covariance.col(kLatency).setZero();
  calibration.covariance(kLatency, kLatency) = latency.sigma_s * latency.sigma_s;
  calibration_root = root_of(calibration);
}

void SharedErrorEstimate::take(const ArrowheadSolver::Solution& solution) {
  calibration = solution.calibration();
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
    drift.node(number).mean = solution.node(number);
  SwayTimeline& sway = drift.sway();
  for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
    Spell& spell = sway.spell(number);
    spell.mean = solution.spell(number);
    spell.per_focal = solution.spell_per_focal(number);
    spell.focal = calibration.mean[CalibrationIndex::kFocal];
  }
  calibration_root = root_of(calibration);
  drift_root = root_of(solution.newest_node_covariance());
}

}  // namespace geoloc
