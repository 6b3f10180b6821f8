// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

namespace geoloc {
namespace {

constexpr double kGate = 11.8, kAmbiguity = 9.0;
constexpr double kOwnSigma_m = 0.05;

/// All looks share a position error of `shared_sigma_m` per axis; nothing else is unknown.
Pairing pairing(std::size_t look, std::size_t track, const Eigen::Vector2d& residual, double shared_sigma_m) {
  Pairing pairing;
  pairing.look = look;
  pairing.track = track;
  pairing.residual = residual;
  pairing.jacobian.setZero();
  pairing.jacobian.middleCols<2>(SharedError::kFrame).diagonal().setConstant(shared_sigma_m);
  pairing.own_covariance = kOwnSigma_m * kOwnSigma_m * Eigen::Matrix2d::Identity();
  return pairing;
}

std::vector<JointAssociation::Match> solve(const std::vector<Eigen::Vector2d>& looks,
                                           const std::vector<Eigen::Vector2d>& tracks, double sigma_m) {
  JointAssociation association(20, 50);
  association.begin(looks.size(), kGate, kAmbiguity);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t k = 0; k < tracks.size(); ++k)
      association.add(pairing(i, k, looks[i] - tracks[k], sigma_m));
  }
  return association.solve();
}

TEST(JointAssociation, MatchesEachLookToTheTrackItIsAt) {
  const std::vector<Eigen::Vector2d> tracks{{0, 0}, {10, 0}, {0, 10}};
  const auto matches = solve({{10.03, 0}, {0, 0.02}, {30, 30}}, tracks, 0.5);
  EXPECT_EQ(matches[0].track, 1U);
  EXPECT_EQ(matches[1].track, 0U);
  EXPECT_EQ(matches[2].track, std::nullopt);
  for (const auto& match : matches) EXPECT_FALSE(match.is_ambiguous);
}

TEST(JointAssociation, SeesThroughAShiftThatPutsEveryLookNearerToTheWrongTrack) {
  // A crooked row, 1.2 m from object to object, seen 0.8 m on: look by look, the next object is nearer.
  const std::vector<Eigen::Vector2d> tracks{{0, 0}, {1.2, 0.1}, {2.4, -0.3}, {3.6, 0.4}, {4.8, 0}};
  std::vector<Eigen::Vector2d> looks;
  for (const Eigen::Vector2d& track : tracks) looks.push_back(track + Eigen::Vector2d(0.8, 0.0));
  const auto matches = solve(looks, tracks, 0.5);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_EQ(matches[i].track, i);
    EXPECT_FALSE(matches[i].is_ambiguous);
    EXPECT_LT(matches[i].innovation.norm(), 0.05);
  }
}

TEST(JointAssociation, ClaimsNothingOfALookThatMayShowEitherOfTwo) {
  const std::vector<Eigen::Vector2d> tracks{{0, 0}, {1.2, 0}};
  EXPECT_TRUE(solve({{0.5, 0}}, tracks, 0.5)[0].is_ambiguous);
  EXPECT_FALSE(solve({{0.05, 0}}, tracks, 0.1)[0].is_ambiguous);
}

TEST(JointAssociation, ClaimsNothingOfALoneLookFarFromItsTrack) {
  EXPECT_TRUE(solve({{1.4, 0}}, {{0, 0}}, 0.5)[0].is_ambiguous);
  EXPECT_FALSE(solve({{0.5, 0}}, {{0, 0}}, 0.5)[0].is_ambiguous);
}

/// Cost of an explanation by its definition: the joint chi-square of all residuals, and the gate for each
/// look left alone.
double joint_cost(const std::vector<Pairing>& pairs, std::size_t alone) {
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Eigen::VectorXd residual(2 * n);
  Eigen::MatrixXd jacobian(2 * n, SharedError::kSize);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Pairing& pair = pairs[static_cast<std::size_t>(i)];
    residual.segment<2>(2 * i) = pair.residual;
    jacobian.middleRows<2>(2 * i) = pair.jacobian;
    covariance.block<2, 2>(2 * i, 2 * i) = pair.own_covariance;
  }
  covariance += jacobian * jacobian.transpose();
  return (n == 0 ? 0.0 : residual.dot(covariance.llt().solve(residual))) + kGate * static_cast<double>(alone);
}

/// The least cost of all one-to-one explanations, by trying every one.
void try_all(std::size_t look, std::size_t looks, std::size_t tracks, const std::vector<Pairing>& all,
             std::vector<Pairing>& chosen, double& best,
             std::vector<std::optional<std::size_t>>& best_tracks) {
  if (look == looks) {
    const double cost = joint_cost(chosen, looks - chosen.size());
    if (cost >= best) return;
    best = cost;
    best_tracks.assign(looks, std::nullopt);
    for (const Pairing& pair : chosen) best_tracks[pair.look] = pair.track;
    return;
  }
  try_all(look + 1, looks, tracks, all, chosen, best, best_tracks);
  for (std::size_t k = 0; k < tracks; ++k) {
    const Pairing& pair = all[look * tracks + k];
    if (std::any_of(chosen.begin(), chosen.end(), [&](const Pairing& c) { return c.track == pair.track; }))
      continue;
    chosen.push_back(pair);
    try_all(look + 1, looks, tracks, all, chosen, best, best_tracks);
    chosen.pop_back();
  }
}

TEST(JointAssociation, FindsTheBestOfAllExplanationsWhereItClaimsOne) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 4.0);
  std::normal_distribution<double> shift(0.0, 0.5), noise(0.0, kOwnSigma_m);
  int claimed = 0, best_found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Eigen::Vector2d> tracks, looks;
    for (int k = 0; k < 4; ++k) tracks.emplace_back(place(random), place(random));
    const Eigen::Vector2d common(shift(random), shift(random));
    for (int i = 0; i < 3; ++i)
      looks.push_back(tracks[static_cast<std::size_t>(i)] + common +
                      Eigen::Vector2d(noise(random), noise(random)));
    const auto matches = solve(looks, tracks, 0.5);

    std::vector<Pairing> all, chosen;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      for (std::size_t k = 0; k < tracks.size(); ++k) all.push_back(pairing(i, k, looks[i] - tracks[k], 0.5));
    }
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::optional<std::size_t>> best_tracks;
    try_all(0, looks.size(), tracks.size(), all, chosen, best, best_tracks);
    for (std::size_t i = 0; i < looks.size(); ++i) {
      if (matches[i].is_ambiguous) continue;
      ++claimed;
      best_found += matches[i].track == best_tracks[i] ? 1 : 0;
    }
  }
  EXPECT_GT(claimed, 600);  // of 900: it does claim most
  EXPECT_GE(best_found, claimed - claimed / 100);
}

}  // namespace
}  // namespace geoloc
