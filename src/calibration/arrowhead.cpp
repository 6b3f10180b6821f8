// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/arrowhead.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr int kCalibration = CalibrationIndex::kSize;
/// Stands for "exactly known": keeps the information finite.
constexpr double kLeastSigma = 1e-9;

// The head in order: the nodes from the oldest on, then the calibration. What objects tie together lies near
// the diagonal then, but for the calibration's rows, which come last and fill nothing.
Eigen::Index place_of(std::uint32_t node, const DriftTimeline& drift) {
  return kNodeSize * static_cast<Eigen::Index>(node - drift.begin());
}

Eigen::Index place_of_calibration(const DriftTimeline& drift) {
  return place_of(drift.end(), drift);
}

/// Of the oldest node that the object was seen at.
Eigen::Index first_place(const Landmark& landmark, const DriftTimeline& drift) {
  return landmark.begin() == landmark.end() ? place_of_calibration(drift)
                                            : place_of(landmark.begin()->number, drift);
}

Eigen::Index size_of_head(int nodes) {
  return kNodeSize * static_cast<Eigen::Index>(nodes) + kCalibration;
}

}  // namespace

ArrowheadSolver::ArrowheadSolver(const CalibrationPrior& prior, int max_nodes)
    : information_(size_of_head(max_nodes + 2)),
      right_hand_side_(size_of_head(max_nodes + 2)),
      gains_(size_of_head(max_nodes + 2), 2) {
  prior_mean_ << prior.boresight_x_deg * kRadPerDeg, prior.boresight_y_deg * kRadPerDeg,
      prior.boresight_z_deg * kRadPerDeg, prior.latency_s, prior.height_m, 0.0, 0.0;
  prior_sigma_ << prior.sigma_boresight_x_deg * kRadPerDeg, prior.sigma_boresight_y_deg * kRadPerDeg,
      prior.sigma_boresight_z_deg * kRadPerDeg, prior.sigma_latency_s, prior.sigma_height_m, 0.0, 0.0;
}

CalibrationVector ArrowheadSolver::prior_sigma(double sigma_offset_m) const {
  CalibrationVector sigma = prior_sigma_;
  sigma.segment<2>(CalibrationIndex::kOffset).setConstant(sigma_offset_m);
  return sigma.cwiseMax(kLeastSigma);
}

void ArrowheadSolver::add_prior(double sigma_offset_m, const DriftTimeline& drift) {
  const CalibrationVector information = prior_sigma(sigma_offset_m).array().square().inverse();
  const Eigen::Index last = place_of_calibration(drift);
  information_.block<kCalibration, kCalibration>(last, last).diagonal() += information;
  right_hand_side_.segment<kCalibration>(last) += information.cwiseProduct(prior_mean_);
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
  const Eigen::Vector2d mean = A_inverse * landmark.b();
  const Eigen::Index last = place_of_calibration(drift);
  const auto& B = landmark.B();
  information_.block<kCalibration, kCalibration>(last, last) +=
      landmark.C() - B.transpose() * (A_inverse * B);
  right_hand_side_.segment<kCalibration>(last) += landmark.g() + B.transpose() * mean;

  std::array<Eigen::Matrix<double, 2, kNodeSize>, Landmark::kMaxNodes> gains;  // A^-1 B, of the nodes
  std::size_t count = 0;
  for (const Landmark::NodeTerms& own : landmark) {
    const Eigen::Index here = place_of(own.number, drift);
    const auto& gain = gains[count++] = A_inverse * own.B;
    right_hand_side_.segment<kNodeSize>(here) += own.g + own.B.transpose() * mean;
    information_.block<kCalibration, kNodeSize>(last, here) += own.C_calibration - B.transpose() * gain;
    information_.block<kNodeSize, kNodeSize>(here, here) += own.C_own - own.B.transpose() * gain;
    const Landmark::NodeTerms* earlier = landmark.begin();
    for (std::size_t i = 0; earlier != &own; ++i, ++earlier) {
      auto block = information_.block<kNodeSize, kNodeSize>(here, place_of(earlier->number, drift));
      block -= own.B.transpose() * gains[i];
      if (earlier->number + 1 == own.number) block += earlier->C_next.transpose();
    }
  }
}

bool ArrowheadSolver::solve(const std::vector<const Landmark*>& landmarks, double sigma_offset_m,
                            DriftTimeline& drift, Calibration& calibration) {
  const Eigen::Index size = size_of_head(drift.size());
  information_.reset(size);
  right_hand_side_.head(size).setZero();
  add_prior(sigma_offset_m, drift);
  for (const Landmark* landmark : landmarks) add_landmark(*landmark, drift);
  if (!information_.factorize()) return false;

  auto solution = right_hand_side_.head(size);
  information_.solve(solution);
  calibration.mean = solution.tail<kCalibration>();
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number) {
    drift.node(number).mean = solution.segment<kNodeSize>(place_of(number, drift));
  }
  const auto covariance = information_.last_of_inverse<kNodeSize + kCalibration>();
  calibration.covariance = covariance.bottomRightCorner<kCalibration, kCalibration>();
  newest_node_covariance_ = covariance.topLeftCorner<kNodeSize, kNodeSize>();
  return true;
}

std::optional<double> ArrowheadSolver::observed_wandering(const DriftTimeline& drift) {
  constexpr int kEnoughNodes = 8;
  if (drift.size() < kEnoughNodes) return std::nullopt;
  double sum = 0.0;
  int count = 0;
  auto steps = gains_.topRows(information_.size());
  for (std::uint32_t number = drift.begin() + 1; number != drift.end(); ++number) {
    const DriftNode& node = drift.node(number);
    const Eigen::Index here = place_of(number, drift), before = here - kNodeSize;
    const Eigen::Array2d transition = node.transition.head<2>();
    const Eigen::Array2d step =
        node.mean.head<2>().array() - transition * drift.node(number - 1).mean.head<2>().array();
    steps.setZero();
    steps.middleRows<2>(here).setIdentity();
    steps.middleRows<2>(before).diagonal() = -transition;
    information_.solve_lower(steps, before);
    const Eigen::Array2d variance = steps.colwise().squaredNorm().transpose();
    sum += ((step.square() + variance) * node.information.head<2>().array()).sum();
    count += 2;
  }
  return std::sqrt(sum / count);
}

void ArrowheadSolver::add_gain(const Landmark& landmark, const DriftTimeline& drift, double sign) const {
  const Eigen::Matrix2d A_inverse = sign * landmark.A().inverse();
  gains_.middleRows<kCalibration>(place_of_calibration(drift)) += landmark.B().transpose() * A_inverse;
  for (const Landmark::NodeTerms& terms : landmark) {
    gains_.middleRows<kNodeSize>(place_of(terms.number, drift)) += terms.B.transpose() * A_inverse;
  }
}

/// G S^-1 G' of the gains gathered, which are zero before `first`.
Eigen::Matrix2d ArrowheadSolver::head_covariance(Eigen::Index first) const {
  auto gains = gains_.topRows(information_.size());
  information_.solve_lower(gains, first);
  const auto used = gains.bottomRows(information_.size() - first);
  return used.transpose().lazyProduct(used);
}

Eigen::Matrix2d ArrowheadSolver::covariance(const Landmark& landmark, const DriftTimeline& drift) const {
  gains_.topRows(information_.size()).setZero();
  add_gain(landmark, drift, 1.0);
  return landmark.A().inverse() + head_covariance(first_place(landmark, drift));
}

Eigen::Matrix2d ArrowheadSolver::covariance_of_difference(const Landmark& a, const Landmark& b,
                                                          const DriftTimeline& drift) const {
  gains_.topRows(information_.size()).setZero();
  add_gain(a, drift, 1.0);
  add_gain(b, drift, -1.0);
  return a.A().inverse() + b.A().inverse() +
         head_covariance(std::min(first_place(a, drift), first_place(b, drift)));
}

}  // namespace geoloc
