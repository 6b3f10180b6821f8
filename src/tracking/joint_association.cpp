// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_association.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geometry/room.hpp"
#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

/// Objects not known yet stand one to 100 m^2 where nothing else is said.
constexpr double kUsualDensityOfNew = 0.01;
/// Assignment and shared error are found in turns.
constexpr int kRounds = 2;
/// Room for as many pairs a look; more are looks in a crowd denser than their own uncertainty.
constexpr std::size_t kPairingsPerLook = 16;

/// Cost of a look that shows no known track, in the units of a squared distance plus the logarithm of its
/// covariance's determinant.
double cost_alone(double density_of_new) {
  return -2.0 * std::log(2.0 * kPi * density_of_new);
}

/// Covariance of a pair's residual, where the shared error has that covariance. lazyProduct: Eigen takes
/// matrices of this size for large ones, and packs them first.
Eigen::Matrix2d residual_covariance(const Pairing& pairing, const SharedError::Matrix& covariance) {
  const SharedError::Row product = pairing.jacobian.lazyProduct(covariance);
  return pairing.own_covariance + product.lazyProduct(pairing.jacobian.transpose());
}

/// The same before anything is known of the shared error.
Eigen::Matrix2d prior_covariance(const Pairing& pairing) {
  return pairing.own_covariance + squared(pairing.jacobian);
}

}  // namespace

JointAssociation::JointAssociation(int max_looks, int max_tracks, std::size_t most_explanations) {
  take_room(this, max_looks, max_tracks, most_explanations);
  std::fill(column_of_track_.begin(), column_of_track_.end(), kNone);
}

std::size_t JointAssociation::take_room(JointAssociation* self, int max_looks, int max_tracks,
                                        std::size_t most_explanations) {
  using Self = JointAssociation;
  std::size_t bytes = room::reserve(self, &Self::pairings_, kPairingsPerLook * max_looks) +
                      room::reserve(self, &Self::pairings_of_look_, max_looks) +
                      room::reserve(self, &Self::least_cost_of_look_, max_looks) +
                      room::reserve(self, &Self::cost_alone_of_look_, max_looks) +
                      room::resize(self, &Self::column_of_track_, max_tracks) +
                      room::reserve(self, &Self::track_of_column_, max_tracks) +
                      room::reserve(self, &Self::pairings_of_column_, max_tracks) +
                      room::resize(self, &Self::costs_, max_looks, max_tracks) +
                      room::resize(self, &Self::pairing_at_, max_looks, max_tracks) +
                      AssignmentSolver::bytes(max_looks, max_tracks) +
                      room::resize(self, &Self::hypotheses_, most_explanations) +
                      room::reserve(self, &Self::matches_, max_looks);
  if (self != nullptr) self->assignment_.reserve(max_looks, max_tracks);
  for (std::size_t i = 0; i < most_explanations; ++i) {
    Hypothesis* const hypothesis = self != nullptr ? &self->hypotheses_[i] : nullptr;
    bytes += room::reserve(hypothesis, &Hypothesis::pairing_of_look, max_looks);
  }
  return bytes;
}

void JointAssociation::begin(std::size_t looks, double gate, double ambiguity) {
  gate_ = gate;
  ambiguity_ = ambiguity;
  pairings_.clear();
  pairings_of_look_.assign(looks, 0);
  least_cost_of_look_.assign(looks, gate);
  cost_alone_of_look_.assign(looks, cost_alone(kUsualDensityOfNew));
  for (const std::size_t track : track_of_column_) column_of_track_[track] = kNone;
  track_of_column_.clear();
  pairings_of_column_.clear();
  hypothesis_count_ = 0;
}

void JointAssociation::expect_new(std::size_t look, double density) {
  cost_alone_of_look_[look] = cost_alone(density);
}

void JointAssociation::add(const Pairing& pairing) {
  if (pairings_.size() == pairings_.capacity()) return;
  const Eigen::Matrix2d covariance = prior_covariance(pairing);
  const double cost = mahalanobis_squared(pairing.residual, covariance) + pairing.penalty;
  if (!(cost < gate_)) return;
  pairings_.push_back(pairing);
  double& least_cost = least_cost_of_look_[pairing.look];
  least_cost = std::min(least_cost, cost + std::log(covariance.determinant()));
  ++pairings_of_look_[pairing.look];
  std::size_t& column = column_of_track_[pairing.track];
  if (column == kNone) {
    column = track_of_column_.size();
    track_of_column_.push_back(pairing.track);
    pairings_of_column_.push_back(0);
  }
  ++pairings_of_column_[column];
}

void JointAssociation::Posterior::add(const Pairing& pairing) {
  const Eigen::Matrix<double, SharedError::kSize, 2> crossed =
      covariance.lazyProduct(pairing.jacobian.transpose());
  const Eigen::Matrix2d innovation_covariance =
      pairing.own_covariance + pairing.jacobian.lazyProduct(crossed);
  const Eigen::Matrix2d information = innovation_covariance.inverse();
  const Eigen::Vector2d innovation = pairing.residual - pairing.jacobian * mean;
  cost += innovation.dot(information * innovation) + std::log(innovation_covariance.determinant()) +
          pairing.penalty;
  const Eigen::Matrix<double, SharedError::kSize, 2> gain = crossed * information;
  mean += gain * innovation;
  covariance -= gain.lazyProduct(crossed.transpose());
}

/// A look with one track, but not near it: it may be of something new.
bool JointAssociation::is_doubtful(std::size_t look) const {
  return pairings_of_look_[look] > 0 &&
         least_cost_of_look_[look] > cost_alone_of_look_[look] - kAmbiguityAlone;
}

/// No look has a choice, and no track.
bool JointAssociation::is_plain() const {
  const auto has_choice = [](int pairs) { return pairs > 1; };
  for (std::size_t look = 0; look < pairings_of_look_.size(); ++look) {
    if (is_doubtful(look)) return false;
  }
  return std::none_of(pairings_of_look_.begin(), pairings_of_look_.end(), has_choice) &&
         std::none_of(pairings_of_column_.begin(), pairings_of_column_.end(), has_choice);
}

void JointAssociation::assign(const Posterior& posterior, const Held& held,
                              std::vector<std::size_t>& pairing_of_look) {
  auto costs = costs_.topLeftCorner(pairings_of_look_.size(), track_of_column_.size());
  costs.setConstant(gate_);
  for (std::size_t p = 0; p < pairings_.size(); ++p) {
    const Pairing& pairing = pairings_[p];
    if (held.excludes(pairing)) continue;
    const std::size_t column = column_of_track_[pairing.track];
    costs(pairing.look, column) = mahalanobis_squared(pairing.residual - pairing.jacobian * posterior.mean,
                                                      residual_covariance(pairing, posterior.covariance)) +
                                  pairing.penalty;
    pairing_at_(pairing.look, column) = p;
  }
  const std::vector<std::size_t>& column_of_look = assignment_.solve(costs, gate_);
  pairing_of_look.assign(pairings_of_look_.size(), kNone);
  for (std::size_t i = 0; i < pairing_of_look.size(); ++i) {
    const std::size_t column = column_of_look[i];
    if (column != AssignmentSolver::kUnassigned) pairing_of_look[i] = pairing_at_(i, column);
  }
}

void JointAssociation::explain(const Pairing* start, const Held& held) {
  if (hypothesis_count_ == hypotheses_.size()) return;
  Hypothesis& hypothesis = hypotheses_[hypothesis_count_++];
  Posterior posterior;
  if (start != nullptr) posterior.add(*start);
  for (int round = 0; round < kRounds; ++round) {
    assign(posterior, held, hypothesis.pairing_of_look);
    posterior = Posterior{};
    for (const std::size_t pairing : hypothesis.pairing_of_look) {
      if (pairing != kNone) posterior.add(pairings_[pairing]);
    }
  }
  hypothesis.posterior = posterior;
  hypothesis.cost = posterior.cost;
  for (std::size_t look = 0; look < pairings_of_look_.size(); ++look) {
    if (hypothesis.pairing_of_look[look] == kNone) hypothesis.cost += cost_alone_of_look_[look];
  }
  hypothesis.cost += held.cost;
}

/// Starts from each pair that no explanation so far holds, where its look has a choice; or from every one.
void JointAssociation::try_other_explanations(Starts starts) {
  for (std::size_t p = 0; p < pairings_.size(); ++p) {
    const std::size_t look = pairings_[p].look;
    const auto end = hypotheses_.begin() + static_cast<std::ptrdiff_t>(hypothesis_count_);
    const bool is_held = std::any_of(hypotheses_.begin(), end, [&](const Hypothesis& hypothesis) {
      return hypothesis.pairing_of_look[look] == p;
    });
    if (starts == Starts::kEveryPairing) {
      explain(&pairings_[p], {kNone, &pairings_[p]});
    } else if (pairings_of_look_[look] > 1 && !is_held) {
      explain(&pairings_[p], {});
    }
  }
  for (std::size_t look = 0; look < pairings_of_look_.size(); ++look) {
    if (starts == Starts::kEveryPairing) {
      explain(nullptr, {look});
    } else if (is_doubtful(look)) {
      explain(nullptr, {look, nullptr, ambiguity_ - kAmbiguityAlone});
    }
  }
}

std::optional<std::size_t> JointAssociation::track_of(const Hypothesis& hypothesis, std::size_t look) const {
  const std::size_t pairing = hypothesis.pairing_of_look[look];
  if (pairing == kNone) return std::nullopt;
  return pairings_[pairing].track;
}

void JointAssociation::report_best() {
  const auto end = hypotheses_.begin() + static_cast<std::ptrdiff_t>(hypothesis_count_);
  const Hypothesis& best = *std::min_element(
      hypotheses_.begin(), end, [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    Match& match = matches_[i];
    match.track = track_of(best, i);
    for (std::size_t h = 0; h < hypothesis_count_; ++h) {
      const Hypothesis& other = hypotheses_[h];
      match.is_ambiguous =
          match.is_ambiguous || (other.cost < best.cost + ambiguity_ && track_of(other, i) != match.track);
    }
    if (!match.track) continue;
    match.pairing = best.pairing_of_look[i];
    const Pairing& pairing = pairings_[match.pairing];
    match.innovation = pairing.residual - pairing.jacobian * best.posterior.mean;
    match.innovation_covariance = residual_covariance(pairing, best.posterior.covariance);
  }
}

JointAssociation::Match JointAssociation::match_of(const Pairing& pairing) const {
  const auto index = static_cast<std::size_t>(&pairing - pairings_.data());
  return {pairing.track, index, false, pairing.residual, prior_covariance(pairing)};
}

double JointAssociation::cost() const {
  Posterior posterior;
  double alone = 0.0;
  for (std::size_t look = 0; look < matches_.size(); ++look) {
    if (matches_[look].track) {
      posterior.add(pairings_[matches_[look].pairing]);
    } else {
      alone += cost_alone_of_look_[look];
    }
  }
  return posterior.cost + alone;
}

const std::vector<JointAssociation::Match>& JointAssociation::solve() {
  matches_.assign(pairings_of_look_.size(), Match{});
  if (is_plain()) {
    for (const Pairing& pairing : pairings_) matches_[pairing.look] = match_of(pairing);
    return matches_;
  }
  explain(nullptr, {});
  try_other_explanations(Starts::kAmbiguousLooks);
  report_best();
  return matches_;
}

const std::vector<JointAssociation::Match>& JointAssociation::solve_thoroughly() {
  matches_.assign(pairings_of_look_.size(), Match{});
  explain(nullptr, {});
  try_other_explanations(Starts::kEveryPairing);
  report_best();
  return matches_;
}

}  // namespace geoloc
