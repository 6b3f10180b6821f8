// SPDX-License-Identifier: Apache-2.0
#include "calibration/shared_error_estimate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

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

double PositionAccuracy::wandering_sigma_m() const {
  return std::sqrt(0.5 * (1.0 - constant_share)) * radial_m;
}

double PositionAccuracy::offset_sigma_m(double wandering_scale) const {
  const double sigma_m = std::sqrt(0.5 * constant_share) * radial_m;
  return std::max(least_offset_sigma_m, wandering_scale * sigma_m);
}

SharedErrorEstimate::SharedErrorEstimate(const PositionAccuracy& reported, const DriftConfig& drift_config,
                                         const ArrowheadSolver& solver)
    : accuracy(reported),
      drift(drift_config),
      calibration(solver.prior(offset_sigma_m())),
      calibration_root(root_of(calibration)),
      drift_root(root_of(NodeMatrix(NodeMatrix::Zero()))) {}

void SharedErrorEstimate::take(const ArrowheadSolver::Solution& solution) {
  calibration = solution.calibration();
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
    drift.node(number).mean = solution.node(number);
  calibration_root = root_of(calibration);
  drift_root = root_of(solution.newest_node_covariance());
}

SharedError::Row SharedErrorEstimate::whitened(const SharedError::CalibrationRow& by_calibration,
                                               const Eigen::Matrix<double, 2, kNodeSize>& by_drift) const {
  SharedError::Row row = SharedError::Row::Zero();
  row.middleCols<SharedError::kCalibrationSize>(SharedError::kCalibration) =
      by_calibration * calibration_root;
  row.middleCols<kNodeSize>(SharedError::kDrift) = by_drift * drift_root;
  return row;
}

}  // namespace geoloc
