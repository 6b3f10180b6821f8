// SPDX-License-Identifier: Apache-2.0
#include "calibration/arrowhead.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "calibration/settled_sums.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geometry/room.hpp"

namespace geoloc {
namespace {

constexpr int kCalibration = CalibrationIndex::kSize;
using UpAndYaw = Eigen::Vector2d;  // of a node
/// Stands for "exactly known": keeps the information finite.
constexpr double kLeastSigma = 1e-9;

int most_nodes(const DriftConfig& drift) {
  return drift.max_nodes + 2;
}

Eigen::Index room_for(const DriftConfig& drift) {
  return HeadLayout{0, static_cast<std::uint32_t>(most_nodes(drift)), 0,
                    static_cast<std::uint32_t>(drift.max_spells) + 2}
      .size();
}

HeadLayout layout_of(const DriftTimeline& drift) {
  return {drift.begin(), drift.end(), drift.sway().begin(), drift.sway().end()};
}

}  // namespace

ArrowheadSolver::ArrowheadSolver(const CalibrationPrior& prior, const DriftConfig& drift)
    : position_prior_(most_nodes(drift)), information_(room_for(drift)) {
  take_room(this, drift);
  const double focal_ratio = 1.0 + 0.01 * prior.focal_percent;
  prior_mean_ << prior.boresight_x_deg * kRadPerDeg, prior.boresight_y_deg * kRadPerDeg,
      prior.boresight_z_deg * kRadPerDeg, prior.latency_s, 0.0, std::log(focal_ratio), prior.position_lag_s,
      0.0, 0.0;
  prior_sigma_ << prior.sigma_boresight_x_deg * kRadPerDeg, prior.sigma_boresight_y_deg * kRadPerDeg,
      prior.sigma_boresight_z_deg * kRadPerDeg, prior.sigma_latency_s, 0.0,
      0.01 * prior.sigma_focal_percent / focal_ratio, prior.sigma_position_lag_s, 0.0, 0.0;
}

std::size_t ArrowheadSolver::take_room(ArrowheadSolver* self, const DriftConfig& drift) {
  const Eigen::Index size = room_for(drift);
  return PositionPrior::take_room(nullptr, most_nodes(drift)) + EnvelopeCholesky::take_room(nullptr, size) +
         room::resize(self, &ArrowheadSolver::right_hand_side_, size) +
         room::resize(self, &ArrowheadSolver::covariances_of_focal_, size) +
         room::resize(self, &ArrowheadSolver::sensitivities_, kPointSize, size) +
         room::resize(self, &ArrowheadSolver::B_, kPointSize, size) +
         room::resize(self, &ArrowheadSolver::gain_, kPointSize, size) +
         room::reserve(self, &ArrowheadSolver::runs_, Landmark::kMaxNodes + Landmark::kMaxSpells + 1);
}

Calibration ArrowheadSolver::prior(const FlightPrior& flight) const {
  CalibrationVector mean = prior_mean_, sigma = prior_sigma_;
  mean[CalibrationIndex::kHeight] = flight.height_m;
  sigma[CalibrationIndex::kHeight] = flight.sigma_height_m;
  sigma.segment<2>(CalibrationIndex::kOffset).setConstant(flight.sigma_offset_m);
  if (flight.latency) {
    mean[CalibrationIndex::kLatency] = flight.latency->latency_s;
    sigma[CalibrationIndex::kLatency] = flight.latency->sigma_s;
  }
  return {mean, sigma.cwiseMax(kLeastSigma).array().square().matrix().asDiagonal()};
}

void ArrowheadSolver::add_prior(const Calibration& prior, const DriftTimeline& drift,
                                const HeadLayout& layout) {
  const CalibrationVector information = prior.covariance.diagonal().cwiseInverse();
  const Eigen::Index last = layout.column_of_calibration();
  information_.block<kCalibration, kCalibration>(last, last).diagonal() += information;
  right_hand_side_.segment<kCalibration>(last) += information.cwiseProduct(prior.mean);
  add_prior_of_position(drift, layout);
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number) {
    const DriftNode& node = drift.node(number);
    const UpAndYaw information_of_node = drift.information(number).tail<2>(),
                   transition = node.transition.tail<2>();
    const Eigen::Index here = layout.column_of(number) + kNodeUp;
    information_.block<2, 2>(here, here).diagonal() += information_of_node;
    right_hand_side_.segment<2>(here) += information_of_node.cwiseProduct(node.prior_mean.tail<2>());
    if (number == drift.begin()) continue;
    const Eigen::Index before = here - kNodeSize;
    const UpAndYaw coupling = transition.cwiseProduct(information_of_node);
    information_.block<2, 2>(before, before).diagonal() += coupling.cwiseProduct(transition);
    information_.block<2, 2>(here, before).diagonal() -= coupling;
  }
}

/// East and north, of which each node depends on all before it.
void ArrowheadSolver::add_prior_of_position(const DriftTimeline& drift, const HeadLayout& layout) {
  for (int component = 0; component < 2; ++component) {
    position_prior_.form(drift, component);
    for (Eigen::Index i = 0; i < position_prior_.size(); ++i) {
      const Eigen::Index row = layout.column_of(drift.begin()) + kNodeSize * i + component;
      for (Eigen::Index j = 0; j <= i; ++j) {
        const Eigen::Index column = layout.column_of(drift.begin()) + kNodeSize * j + component;
        const double information = position_prior_.information(i, j);
        information_.block<1, 1>(row, column)(0, 0) += information;
        right_hand_side_[row] += information * position_prior_.mean(j);
        if (j < i) right_hand_side_[column] += information * position_prior_.mean(i);
      }
    }
  }
}

void ArrowheadSolver::add_prior_of_sway(const SwayTimeline& sway, const HeadLayout& layout) {
  if (is_focal_unknown() && sway.size() > 0) add_frozen_sway(sway, layout);
  for (std::uint32_t number = sway.begin(); number != sway.end(); ++number) {
    const Spell& spell = sway.spell(number);
    const SwayVector information = sway.information(number);
    const Eigen::Index here = layout.column_of_spell(number);
    information_.block<kSwaySize, kSwaySize>(here, here).diagonal() += information;
    right_hand_side_.segment<kSwaySize>(here) += information.cwiseProduct(spell.prior_mean);
    if (number == sway.begin()) continue;
    const Eigen::Index before = here - kSwaySize;
    information_.block<kSwaySize, kSwaySize>(before, before).diagonal() +=
        spell.transition * spell.transition * information;
    information_.block<kSwaySize, kSwaySize>(here, before).diagonal() -= spell.transition * information;
  }
}

/// What the frozen spells, and the oldest of the others by the one before, say of the focal length.
void ArrowheadSolver::add_frozen_sway(const SwayTimeline& sway, const HeadLayout& layout) {
  constexpr int kFocal = CalibrationIndex::kFocal;
  const Eigen::Index last = layout.column_of_calibration(), here = layout.column_of_spell(sway.begin());
  const Spell& oldest = sway.spell(sway.begin());
  const SwayVector coupling = sway.information(sway.begin()).cwiseProduct(oldest.prior_per_focal);
  const FocalInformation& known = sway.of_focal();
  information_.block<kCalibration, kSwaySize>(last, here).row(kFocal) -= coupling.transpose();
  information_.block<kCalibration, kCalibration>(last, last)(kFocal, kFocal) +=
      known.information + coupling.dot(oldest.prior_per_focal);
  right_hand_side_[last + kFocal] += known.vector - coupling.dot(oldest.prior_mean);
}

/// An observation of the constant height, and of the up components of the two nodes around it.
void ArrowheadSolver::add_heights(const HeightLog& heights, const HeadLayout& layout) {
  constexpr int kHeight = CalibrationIndex::kHeight;
  const Eigen::Index last = layout.column_of_calibration();
  auto constant = information_.block<kCalibration, kCalibration>(last, last);
  constant(kHeight, kHeight) += heights.constant().information;
  right_hand_side_[last + kHeight] += heights.constant().vector;
  for (const HeightObservation& seen : heights.observations()) {
    const double second = seen.span.weight_of_second, first = 1.0 - second, weight = seen.information;
    const Eigen::Index here = layout.column_of(seen.span.first), next = here + kNodeSize;
    information_.block<kNodeSize, kNodeSize>(here, here)(kNodeUp, kNodeUp) += weight * first * first;
    information_.block<kNodeSize, kNodeSize>(next, here)(kNodeUp, kNodeUp) += weight * second * first;
    information_.block<kNodeSize, kNodeSize>(next, next)(kNodeUp, kNodeUp) += weight * second * second;
    information_.block<kCalibration, kNodeSize>(last, here)(kHeight, kNodeUp) += weight * first;
    information_.block<kCalibration, kNodeSize>(last, next)(kHeight, kNodeUp) += weight * second;
    constant(kHeight, kHeight) += weight;
    right_hand_side_[here + kNodeUp] += weight * first * seen.value_m;
    right_hand_side_[next + kNodeUp] += weight * second * seen.value_m;
    right_hand_side_[last + kHeight] += weight * seen.value_m;
  }
}

/// Adds C - B' A^-1 B to the lower triangle and g + B' A^-1 b to the right-hand side.
void ArrowheadSolver::add_landmark(const Landmark& landmark, const HeadLayout& layout) {
  add_own(landmark, layout);
  spread(landmark, layout);
  eliminate(landmark.A(), landmark.b());
}

/// C and g.
void ArrowheadSolver::add_own(const Landmark& landmark, const HeadLayout& layout) {
  const Eigen::Index last = layout.column_of_calibration();
  information_.block<kCalibration, kCalibration>(last, last) += landmark.C();
  right_hand_side_.segment<kCalibration>(last) += landmark.g();
  for (const Landmark::NodeTerms& own : landmark) {
    const Eigen::Index here = layout.column_of(own.number);
    information_.block<kCalibration, kNodeSize>(last, here) += own.C_calibration;
    information_.block<kNodeSize, kNodeSize>(here, here) += own.C_own;
    right_hand_side_.segment<kNodeSize>(here) += own.g;
    const Landmark::NodeTerms* const next = &own + 1;
    if (next != landmark.end() && next->number == own.number + 1)
      information_.block<kNodeSize, kNodeSize>(here + kNodeSize, here) += own.C_next.transpose();
  }
  for (const Landmark::SpellTerms& own : landmark.spells()) {
    const Eigen::Index here = layout.column_of_spell(own.number);
    information_.block<kCalibration, kSwaySize>(last, here) += own.C_calibration;
    information_.block<kSwaySize, kSwaySize>(here, here) += own.C_own;
    right_hand_side_.segment<kSwaySize>(here) += own.g;
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (layout.has_node(own.node + side))
        information_.block<kNodeSize, kSwaySize>(layout.column_of(own.node + side), here) += own.C_node[side];
    }
  }
}

void ArrowheadSolver::spread(const Landmark& landmark, const HeadLayout& layout) {
  runs_.clear();
  const auto put = [&](Eigen::Index column, const auto& B) {
    B_.middleCols<std::decay_t<decltype(B)>::ColsAtCompileTime>(column) = B;
    if (runs_.empty() || runs_.back().end != column) runs_.push_back({column, column});
    runs_.back().end += B.cols();
  };
  for (const Landmark::SpellTerms& terms : landmark.spells())
    put(layout.column_of_spell(terms.number), terms.B);
  for (const Landmark::NodeTerms& terms : landmark) put(layout.column_of(terms.number), terms.B);
  put(layout.column_of_calibration(), landmark.B());
}

/// Row by row, so that each is a sum of three rows in the order that they lie in memory.
void ArrowheadSolver::eliminate(const PointMatrix& A, const Point& b) {
  const PointMatrix A_inverse = A.inverse();
  const Point mean = A_inverse * b;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Run& rows = runs_[i];
    const Eigen::Index count = rows.end - rows.begin;
    gain_.middleCols(rows.begin, count) = A_inverse.lazyProduct(B_.middleCols(rows.begin, count));
    for (Eigen::Index row = rows.begin; row < rows.end; ++row) {
      const Point B = B_.col(row);
      right_hand_side_[row] += B.dot(mean);
      for (std::size_t k = 0; k <= i; ++k) {
        const Eigen::Index begin = runs_[k].begin, size = std::min(runs_[k].end, row + 1) - begin;
        information_.subtract(row, begin, B, gain_, size);
      }
    }
  }
}

void ArrowheadSolver::find_covariances_of_focal(const HeadLayout& layout) {
  covariances_of_focal_.head(layout.size()).setZero();
  covariances_of_focal_[layout.column_of_calibration() + CalibrationIndex::kFocal] = 1.0;
  information_.solve(covariances_of_focal_.head(layout.size()));
}

std::optional<ArrowheadSolver::Solution> ArrowheadSolver::solve(const std::vector<const Landmark*>& landmarks,
                                                                const FlightPrior& prior,
                                                                const DriftTimeline& drift,
                                                                const HeightLog& heights,
                                                                const SettledSums* settled) {
  const HeadLayout layout = layout_of(drift);
  information_.reset(layout.size());
  right_hand_side_.head(layout.size()).setZero();
  add_prior(this->prior(prior), drift, layout);
  add_prior_of_sway(drift.sway(), layout);
  add_heights(heights, layout);
  if (settled != nullptr) settled->add_to(information_, right_hand_side_, layout);
  for (const Landmark* landmark : landmarks) add_landmark(*landmark, layout);
  if (!information_.factorize()) return std::nullopt;
  information_.solve(right_hand_side_.head(layout.size()));
  if (is_focal_unknown()) find_covariances_of_focal(layout);
  return Solution(*this, layout);
}

}  // namespace geoloc
