// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/arrowhead.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr Eigen::Index kCalibration = CalibrationIndex::kSize;
/// Stands for "exactly known": keeps the information finite.
constexpr double kLeastSigma = 1e-9;

Eigen::Index place_of(std::uint32_t node, const DriftTimeline& drift) {
  return kCalibration + kNodeSize * static_cast<Eigen::Index>(node - drift.begin());
}

}  // namespace

ArrowheadSolver::ArrowheadSolver(const CalibrationPrior& prior, int max_nodes) {
  prior_mean_ << prior.boresight_x_deg * kRadPerDeg, prior.boresight_y_deg * kRadPerDeg,
      prior.boresight_z_deg * kRadPerDeg, prior.latency_s, prior.height_m, 0.0, 0.0;
  prior_sigma_ << prior.sigma_boresight_x_deg * kRadPerDeg, prior.sigma_boresight_y_deg * kRadPerDeg,
      prior.sigma_boresight_z_deg * kRadPerDeg, prior.sigma_latency_s, prior.sigma_height_m, 0.0, 0.0;
  const Eigen::Index most = kCalibration + kNodeSize * static_cast<Eigen::Index>(max_nodes + 2);
  information_.resize(most, most);
  right_hand_side_.resize(most);
  columns_.resize(most, kCalibration + kNodeSize);
  gains_.resize(most, 2);
  inverse_.resize(most, most);
}

CalibrationVector ArrowheadSolver::prior_sigma(double sigma_offset_m) const {
  CalibrationVector sigma = prior_sigma_;
  sigma.segment<2>(CalibrationIndex::kOffset).setConstant(sigma_offset_m);
  return sigma.cwiseMax(kLeastSigma);
}

void ArrowheadSolver::add_prior(double sigma_offset_m, const DriftTimeline& drift) {
  const CalibrationVector information = prior_sigma(sigma_offset_m).array().square().inverse();
  information_.topLeftCorner<kCalibration, kCalibration>().diagonal() += information;
  right_hand_side_.head<kCalibration>() += information.cwiseProduct(prior_mean_);
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number) {
    const DriftNode& node = drift.node(number);
    const NodeVector information_of_node = drift.information(number);
    const Eigen::Index here = place_of(number, drift);
    information_.block<kNodeSize, kNodeSize>(here, here).diagonal() += information_of_node;
    right_hand_side_.segment<kNodeSize>(here) += information_of_node.cwiseProduct(node.prior_mean);
    if (number == drift.begin()) continue;
    const Eigen::Index before = here - kNodeSize;
    const NodeVector coupling = node.transition.cwiseProduct(information_of_node);
    information_.block<kNodeSize, kNodeSize>(before, before).diagonal() +=
        coupling.cwiseProduct(node.transition);
    information_.block<kNodeSize, kNodeSize>(here, before).diagonal() -= coupling;
  }
}

/// Adds C - B' A^-1 B to the lower triangle and g + B' A^-1 b to the right-hand side.
void ArrowheadSolver::add_landmark(const Landmark& landmark, const DriftTimeline& drift) {
  const Eigen::Matrix2d A_inverse = landmark.A().inverse();
  const Landmark::CalibrationRow gain = A_inverse * landmark.B();
  const Eigen::Vector2d mean = A_inverse * landmark.b();
  information_.topLeftCorner<kCalibration, kCalibration>() += landmark.C() - landmark.B().transpose() * gain;
  right_hand_side_.head<kCalibration>() += landmark.g() + landmark.B().transpose() * mean;
  for (const Landmark::NodeTerms& own : landmark) {
    const Eigen::Index here = place_of(own.number, drift);
    const Eigen::Matrix<double, 2, kNodeSize> own_gain = A_inverse * own.B;
    right_hand_side_.segment<kNodeSize>(here) += own.g + own.B.transpose() * mean;
    information_.block<kNodeSize, kCalibration>(here, 0) +=
        own.C_calibration.transpose() - own.B.transpose() * gain;
    information_.block<kNodeSize, kNodeSize>(here, here) += own.C_own - own.B.transpose() * own_gain;
    for (const Landmark::NodeTerms* earlier = landmark.begin(); earlier != &own; ++earlier) {
      auto block = information_.block<kNodeSize, kNodeSize>(here, place_of(earlier->number, drift));
      block -= own.B.transpose() * (A_inverse * earlier->B);
      if (earlier->number + 1 == own.number) block += earlier->C_next.transpose();
    }
  }
}

void ArrowheadSolver::solve(const std::vector<const Landmark*>& landmarks, double sigma_offset_m,
                            DriftTimeline& drift, Calibration& calibration) {
  size_ = place_of(drift.end(), drift);
  information_.topLeftCorner(size_, size_).setZero();
  right_hand_side_.head(size_).setZero();
  add_prior(sigma_offset_m, drift);
  for (const Landmark* landmark : landmarks) add_landmark(*landmark, drift);

  // In place: the lower triangle becomes the factor L of S = L L'.
  Eigen::Ref<Eigen::MatrixXd> information = information_.topLeftCorner(size_, size_);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(information);
  auto solution = right_hand_side_.head(size_);
  factor.solveInPlace(solution);
  calibration.mean = solution.head<kCalibration>();
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number) {
    drift.node(number).mean = solution.segment<kNodeSize>(place_of(number, drift));
  }

  // Covariance of calibration and newest node: columns of L^-1 suffice.
  auto columns = columns_.topRows(size_);
  columns.setZero();
  columns.topLeftCorner<kCalibration, kCalibration>().setIdentity();
  columns.bottomRightCorner<kNodeSize, kNodeSize>().setIdentity();
  information.triangularView<Eigen::Lower>().solveInPlace(columns);
  calibration.covariance.noalias() =
      columns.leftCols<kCalibration>().transpose() * columns.leftCols<kCalibration>();
  newest_node_covariance_.noalias() =
      columns.rightCols<kNodeSize>().transpose() * columns.rightCols<kNodeSize>();
}

std::optional<double> ArrowheadSolver::observed_wandering(const DriftTimeline& drift) {
  constexpr int kEnoughNodes = 8;
  if (drift.size() < kEnoughNodes) return std::nullopt;
  // Covariance of all nodes from the inverse of the factor.
  auto inverse = inverse_.topLeftCorner(size_, size_);
  inverse.setIdentity();
  information_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solveInPlace(inverse);
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t number = drift.begin() + 1; number != drift.end(); ++number) {
    const DriftNode& node = drift.node(number);
    const NodeVector unit_information = node.information;
    const Eigen::Index here = place_of(number, drift);
    for (int axis = 0; axis < 2; ++axis) {
      const double transition = node.transition[axis];
      const double step = node.mean[axis] - transition * drift.node(number - 1).mean[axis];
      const double variance =
          (inverse.col(here + axis) - transition * inverse.col(here - kNodeSize + axis)).squaredNorm();
      sum += (step * step + variance) * unit_information[axis];
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

void ArrowheadSolver::add_gain(const Landmark& landmark, const DriftTimeline& drift, double sign) const {
  const Eigen::Matrix2d A_inverse = sign * landmark.A().inverse();
  gains_.topRows<kCalibration>() += landmark.B().transpose() * A_inverse;
  for (const Landmark::NodeTerms& terms : landmark) {
    gains_.middleRows<kNodeSize>(place_of(terms.number, drift)) += terms.B.transpose() * A_inverse;
  }
}

/// G S^-1 G' of the gains gathered.
Eigen::Matrix2d ArrowheadSolver::head_covariance() const {
  auto gains = gains_.topRows(size_);
  information_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solveInPlace(gains);
  return gains.transpose() * gains;
}

Eigen::Matrix2d ArrowheadSolver::covariance(const Landmark& landmark, const DriftTimeline& drift) const {
  gains_.topRows(size_).setZero();
  add_gain(landmark, drift, 1.0);
  return landmark.A().inverse() + head_covariance();
}

Eigen::Matrix2d ArrowheadSolver::covariance_of_difference(const Landmark& a, const Landmark& b,
                                                          const DriftTimeline& drift) const {
  gains_.topRows(size_).setZero();
  add_gain(a, drift, 1.0);
  add_gain(b, drift, -1.0);
  return a.A().inverse() + b.A().inverse() + head_covariance();
}

}  // namespace geoloc
