// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "geoloc/geometry/angles.hpp"

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

TEST(JointAssociation, OfTwoExplanationsThatAreEquallyGoodTakesTheFirst) {
  JointAssociation association(5, 5);
  for (const double side : {-1.0, 1.0}) {
    association.begin(1, kGate, 0.0);
    association.add(pairing(0, 3, {side * 0.1, 0.0}, 0.5));
    association.add(pairing(0, 1, {side * -0.1, 0.0}, 0.5));
    EXPECT_EQ(association.solve()[0].track, 3U);
  }
}

/// All residuals of some pairs as one, with its Jacobian by the shared error and the pairs' own covariance.
struct Stacked {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd own_covariance;
};

Stacked stacked(const std::vector<Pairing>& pairs) {
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Stacked all{Eigen::VectorXd(2 * n), Eigen::MatrixXd(2 * n, SharedError::kSize),
              Eigen::MatrixXd::Zero(2 * n, 2 * n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Pairing& pair = pairs[static_cast<std::size_t>(i)];
    all.residual.segment<2>(2 * i) = pair.residual;
    all.jacobian.middleRows<2>(2 * i) = pair.jacobian;
    all.own_covariance.block<2, 2>(2 * i, 2 * i) = pair.own_covariance;
  }
  return all;
}

/// Cost of an explanation by its definition: the joint chi-square of all residuals, and the gate for each
/// look left alone.
double joint_cost(const std::vector<Pairing>& pairs, std::size_t alone) {
  const auto [residual, jacobian, own] = stacked(pairs);
  const Eigen::MatrixXd covariance = own + jacobian * jacobian.transpose();
  return (pairs.empty() ? 0.0 : residual.dot(covariance.llt().solve(residual))) +
         kGate * static_cast<double>(alone);
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

/// Gaussian conditioning over all pairs of an explanation at once: what is known of the shared error then.
struct Conditioned {
  SharedError::Vector mean = SharedError::Vector::Zero();
  SharedError::Matrix covariance = SharedError::Matrix::Identity();
  double cost = 0.0;  ///< -2 ln of the density of all residuals, but for the 2 pi
};

Conditioned conditioned_on(const std::vector<Pairing>& pairs) {
  Conditioned result;
  if (pairs.empty()) return result;
  const auto [residual, jacobian, own] = stacked(pairs);
  for (const Pairing& pair : pairs) result.cost += pair.penalty;
  const Eigen::MatrixXd total = own + jacobian * jacobian.transpose();
  const Eigen::MatrixXd gain = jacobian.transpose() * total.inverse();
  result.mean = gain * residual;
  result.covariance -= gain * jacobian;
  result.cost += residual.dot(total.llt().solve(residual)) + std::log(total.determinant());
  return result;
}

/// A frame with a choice: two looks at two of three tracks, that share errors of several kinds.
class JointFrameOfTwoLooks : public ::testing::Test {
 protected:
  static Pairing drawn(std::size_t look, std::size_t track, const Eigen::Vector2d& residual,
                       std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 0.2);
    Pairing pairing;
    pairing.look = look;
    pairing.track = track;
    pairing.residual = residual;
    for (double& value : pairing.jacobian.reshaped()) value = normal(random);
    pairing.own_covariance << 0.02, 0.005, 0.005, 0.03;
    return pairing;
  }
};

TEST_F(JointFrameOfTwoLooks, InnovationsAreThoseOfGaussianConditioning) {
  std::mt19937 random(4);
  JointAssociation association(5, 5);
  association.begin(2, 1000.0, 0.0);
  std::vector<Pairing> right{drawn(0, 1, {0.1, -0.2}, random), drawn(1, 2, {-0.1, 0.05}, random)};
  right[1].penalty = 0.5;
  for (const Pairing& pair : right) association.add(pair);
  association.add(drawn(0, 0, {3.0, 3.0}, random));
  association.add(drawn(1, 0, {-3.0, 3.0}, random));
  const auto& matches = association.solve();
  const Conditioned expected = conditioned_on(right);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(matches[i].track, right[i].track);
    EXPECT_TRUE(matches[i].is_certain());
    EXPECT_LT((matches[i].innovation - (right[i].residual - right[i].jacobian * expected.mean)).norm(), 1e-9);
    const Eigen::Matrix2d covariance =
        right[i].own_covariance + right[i].jacobian * expected.covariance * right[i].jacobian.transpose();
    EXPECT_LT((matches[i].innovation_covariance - covariance).norm(), 1e-9);
  }
}

TEST_F(JointFrameOfTwoLooks, WithoutAChoiceEachLookIsItsTracksByItself) {
  std::mt19937 random(4);
  JointAssociation association(5, 5);
  association.begin(3, kGate, kAmbiguity);
  const std::vector<Pairing> pairs{drawn(0, 3, {0.1, -0.2}, random), drawn(2, 1, {-0.1, 0.05}, random)};
  for (const Pairing& pair : pairs) association.add(pair);
  const auto& matches = association.solve();
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_FALSE(matches[1].track);
  EXPECT_FALSE(matches[1].is_certain());
  for (const Pairing& pair : pairs) {
    const auto& match = matches[pair.look];
    EXPECT_EQ(match.track, pair.track);
    EXPECT_TRUE(match.is_certain());
    EXPECT_EQ(match.innovation, pair.residual);
    const Eigen::Matrix2d covariance = pair.own_covariance + pair.jacobian * pair.jacobian.transpose();
    EXPECT_LT((match.innovation_covariance - covariance).norm(), 1e-12);
  }
}

/// A frame whose second look is in doubt, and then one that has no second look.
TEST_F(JointFrameOfTwoLooks, HaveNoPartInTheNextFrame) {
  JointAssociation association(5, 5);
  const Pairing sure = pairing(0, 0, {0.3, 0.0}, 0.5);
  association.begin(2, kGate, kAmbiguity);
  association.add(sure);
  association.add(pairing(1, 1, {1.5, 0.0}, 0.5));
  EXPECT_FALSE(association.solve()[1].is_certain());
  association.begin(1, kGate, kAmbiguity);
  association.add(sure);
  const auto& matches = association.solve();
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_TRUE(matches[0].is_certain());
  EXPECT_EQ(matches[0].innovation, sure.residual);  // by itself: there is no choice
}

/// The gate is that of a pair by itself, the penalty included.
TEST_F(JointFrameOfTwoLooks, PairsBeyondTheGateAreDropped) {
  JointAssociation association(5, 5);
  association.begin(2, 9.0, kAmbiguity);
  const double sigma_m = std::hypot(kOwnSigma_m, 0.5);
  association.add(pairing(0, 0, {2.9 * sigma_m, 0.0}, 0.5));
  association.add(pairing(0, 1, {3.1 * sigma_m, 0.0}, 0.5));
  Pairing penalised = pairing(1, 0, {2.0 * sigma_m, 0.0}, 0.5);
  penalised.penalty = 4.9;
  association.add(penalised);
  penalised.track = 2;
  penalised.penalty = 5.1;
  association.add(penalised);
  Pairing broken = pairing(1, 3, {0.0, std::nan("")}, 0.5);
  association.add(broken);
  ASSERT_EQ(association.pairings().size(), 2U);
  EXPECT_EQ(association.pairings()[0].track, 0U);
  EXPECT_EQ(association.pairings()[1].look, 1U);
  EXPECT_EQ(association.looks_at(0), 2);
  association.begin(1, 9.0, kAmbiguity);  // nothing of the frame before is left
  EXPECT_TRUE(association.pairings().empty());
  association.add(pairing(0, 0, {0.0, 0.0}, 0.5));
  EXPECT_EQ(association.looks_at(0), 1);
}

constexpr double kUsualDensity = 0.01;                                 ///< of something new [1/m^2]
const double kLookAlone = -2.0 * std::log(2.0 * kPi * kUsualDensity);  ///< where one object stands on 100 m^2
/// By as much more may leaving a look alone cost, so that it may as well be of something new.
constexpr double kDoubt = 2.0;

/// The only look of a frame, at the only track near it.
class LoneLook {
 public:
  explicit LoneLook(const Pairing& pairing)
      : pairing_(pairing),
        covariance_(pairing.own_covariance + pairing.jacobian * pairing.jacobian.transpose()) {}

  /// -2 ln of the density of a look that is so far off, but for the 2 pi: d^2 + ln det S, and the penalty.
  double cost_at(double squared_distance) const {
    return squared_distance + std::log(covariance_.determinant()) + pairing_.penalty;
  }

  /// The look is so far off, in that direction. A thorough answer is the same where something new is as much
  /// rarer as a plain one holds it for: there, leaving a look alone is an explanation like any other.
  JointAssociation::Match match_at(double squared_distance, const Eigen::Vector2d& direction) {
    pairing_.residual =
        direction * std::sqrt(squared_distance / direction.dot(covariance_.inverse() * direction));
    JointAssociation association(5, 5);
    association.begin(1, kGate, kAmbiguity);
    association.add(pairing_);
    const JointAssociation::Match match = association.solve()[0];
    association.expect_new(0, kUsualDensity * std::exp(-0.5 * (kAmbiguity - kDoubt)));
    const JointAssociation::Match same = association.solve_thoroughly()[0];
    EXPECT_EQ(match.track, same.track);
    EXPECT_EQ(match.is_ambiguous, same.is_ambiguous);
    return match;
  }

 private:
  Pairing pairing_;
  Eigen::Matrix2d covariance_;
};

/// Something new is about as likely where the look's density at its track is as low, be it far from the track
/// or the track's place unsure. Beyond the gate, the look is certainly of something new.
TEST_F(JointFrameOfTwoLooks, ALoneLookIsInDoubtWhereSomethingNewIsAboutAsLikely) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> scale(0.1, 3.0), angle(0.0, 6.28), penalty(0.0, 2.0);
  const double kBound = kLookAlone - kDoubt;
  int certain_to_the_gate = 0, never_certain = 0, at_the_bound = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Pairing pairing = drawn(0, 3, {0.0, 0.0}, random);
    const double sigma = scale(random) * scale(random);
    pairing.jacobian *= sigma;
    pairing.own_covariance *= sigma * sigma;
    pairing.penalty = trial % 2 == 0 ? 0.0 : penalty(random);
    LoneLook look(pairing);
    const double towards = angle(random);
    const Eigen::Vector2d direction(std::cos(towards), std::sin(towards));
    const double gate = kGate - pairing.penalty;
    const double bound = kBound - look.cost_at(0.0);  // of the squared distance
    for (const double distance : {0.0, 0.3 * gate, 0.7 * gate, 0.999 * gate, bound - 0.01, bound + 0.01}) {
      if (distance < 0.0 || distance > gate) continue;
      const auto match = look.match_at(distance, direction);
      EXPECT_EQ(match.is_certain(), distance < bound) << trial << ": " << distance << " of " << bound;
      EXPECT_EQ(match.is_ambiguous, distance > bound) << trial << ": " << distance << " of " << bound;
      EXPECT_EQ(match.track.has_value(), distance < bound + kAmbiguity) << trial << ": " << distance;
    }
    const auto beyond = look.match_at(gate + 0.01, direction);
    EXPECT_FALSE(beyond.track);
    EXPECT_FALSE(beyond.is_ambiguous);
    certain_to_the_gate += bound > gate ? 1 : 0;
    never_certain += bound < 0.0 ? 1 : 0;
    at_the_bound += bound > 0.0 && bound < gate ? 1 : 0;
  }
  EXPECT_GT(certain_to_the_gate, 20);
  EXPECT_GT(never_certain, 20);
  EXPECT_GT(at_the_bound, 200);
}

/// A tenth as dense, or ten times: by the density of what may be new where the look falls.
TEST_F(JointFrameOfTwoLooks, ALoneLookIsInDoubtTheFartherTheRarerSomethingNewIs) {
  const Pairing at_track = pairing(0, 0, {0.0, 0.0}, 0.5);
  const Eigen::Matrix2d covariance =
      at_track.own_covariance + at_track.jacobian * at_track.jacobian.transpose();
  for (const double density : {0.001, 0.005, 0.02, 0.05}) {
    const double alone = -2.0 * std::log(2.0 * kPi * density);
    const double bound = alone - kDoubt - std::log(covariance.determinant());
    ASSERT_GT(bound, 0.5);
    for (const double squared : {bound - 0.01, bound + 0.01}) {
      if (squared > kGate) continue;
      Pairing pair = at_track;
      pair.residual.x() = std::sqrt(squared * covariance(0, 0));
      JointAssociation association(5, 5);
      association.begin(2, kGate, kAmbiguity);
      association.expect_new(0, density);
      association.add(pair);
      EXPECT_EQ(association.solve()[0].is_certain(), squared < bound) << density;
      // What is expected beside one look is not expected beside another, nor in the next frame.
      association.begin(1, kGate, kAmbiguity);
      association.add(pair);
      const double usual = kLookAlone - kDoubt - std::log(covariance.determinant());
      EXPECT_EQ(association.solve()[0].is_certain(), squared < usual) << density;
    }
  }
}

/// Where a look has a choice and where none has: the cost is that of the explanation that is reported, all
/// residuals weighed together, and of looks left alone the density of what is new.
TEST_F(JointFrameOfTwoLooks, CostWhatTheirJointDensityAndNewObjectsDo) {
  std::mt19937 random(21);
  std::normal_distribution<double> normal(0.0, 0.8);
  int plain = 0, with_a_choice = 0, alone = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::array<double, 3> densities{0.001, 0.01, 0.03};
    JointAssociation association(5, 5);
    association.begin(3, kGate, 0.0);
    for (std::size_t i = 0; i < 3; ++i) association.expect_new(i, densities[i]);
    std::vector<Pairing> pairs{drawn(0, 1, {normal(random), normal(random)}, random),
                               drawn(1, 2, {normal(random), normal(random)}, random)};
    if (trial % 2 == 0) pairs.push_back(drawn(0, 2, {normal(random), normal(random)}, random));
    pairs[1].penalty = 0.5;
    for (const Pairing& pair : pairs) association.add(pair);
    const auto& matches = association.solve();
    std::vector<Pairing> chosen;
    double expected = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!matches[i].track) expected -= 2.0 * std::log(2.0 * kPi * densities[i]);
      for (const Pairing& pair : association.pairings()) {
        if (pair.look == i && matches[i].track == pair.track) chosen.push_back(pair);
      }
    }
    expected += conditioned_on(chosen).cost;
    EXPECT_NEAR(association.cost(), expected, 1e-9) << trial;
    (association.pairings().size() == 3 ? with_a_choice : plain) += 1;
    alone += chosen.size() < 2 ? 1 : 0;
  }
  EXPECT_GT(plain, 50);
  EXPECT_GT(with_a_choice, 50);
  EXPECT_GT(alone, 20);
}

struct Explained {
  std::vector<std::optional<std::size_t>> tracks;
  double cost;
};

/// Every one-to-one explanation with its exact cost.
void list_all(std::size_t look, std::size_t looks, const std::vector<Pairing>& within_gate,
              std::vector<Pairing>& chosen, std::vector<Explained>& all) {
  if (look == looks) {
    Explained explained{std::vector<std::optional<std::size_t>>(looks), conditioned_on(chosen).cost};
    for (const Pairing& pair : chosen) explained.tracks[pair.look] = pair.track;
    explained.cost += kLookAlone * static_cast<double>(looks - chosen.size());
    all.push_back(explained);
    return;
  }
  list_all(look + 1, looks, within_gate, chosen, all);
  for (const Pairing& pair : within_gate) {
    if (pair.look != look ||
        std::any_of(chosen.begin(), chosen.end(), [&](const Pairing& c) { return c.track == pair.track; }))
      continue;
    chosen.push_back(pair);
    list_all(look + 1, looks, within_gate, chosen, all);
    chosen.pop_back();
  }
}

/// Where the answer is sure it is the best explanation's, and no other within the ambiguity says otherwise;
/// where it is not there is one. Some explanations are tried, not all: a few answers in a hundred may differ.
void expect_agreement_with_all_explanations(
    const std::vector<JointAssociation::Match>& (JointAssociation::*solve)()) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(0.0, 2.0);
  std::normal_distribution<double> shift(0.0, 0.4), noise(0.0, kOwnSigma_m);
  int same_track = 0, same_doubt = 0, doubtful = 0, looks_in_all = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<Eigen::Vector2d> tracks, looks;
    for (int k = 0; k < 4; ++k) tracks.emplace_back(place(random), place(random));
    const Eigen::Vector2d common(shift(random), shift(random));
    for (std::size_t i = 0; i < 2; ++i)
      looks.push_back(tracks[i] + common + Eigen::Vector2d(noise(random), noise(random)));
    JointAssociation association(5, 5);
    association.begin(looks.size(), kGate, kAmbiguity);
    for (std::size_t i = 0; i < looks.size(); ++i) {
      for (std::size_t k = 0; k < tracks.size(); ++k)
        association.add(pairing(i, k, looks[i] - tracks[k], 0.4));
    }
    const auto matches = (association.*solve)();
    std::vector<Explained> all;
    std::vector<Pairing> chosen;
    list_all(0, looks.size(), association.pairings(), chosen, all);
    const Explained& best = *std::min_element(
        all.begin(), all.end(), [](const Explained& a, const Explained& b) { return a.cost < b.cost; });
    for (std::size_t i = 0; i < looks.size(); ++i) {
      const bool is_ambiguous = std::any_of(all.begin(), all.end(), [&](const Explained& other) {
        return other.cost < best.cost + kAmbiguity && other.tracks[i] != best.tracks[i];
      });
      ++looks_in_all;
      doubtful += is_ambiguous ? 1 : 0;
      same_track += matches[i].track == best.tracks[i] ? 1 : 0;
      same_doubt += matches[i].is_ambiguous == is_ambiguous ? 1 : 0;
    }
  }
  EXPECT_GT(doubtful, looks_in_all / 10);
  EXPECT_LT(doubtful, looks_in_all / 2);
  EXPECT_GT(same_track, looks_in_all - looks_in_all / 100);
  EXPECT_GT(same_doubt, looks_in_all - looks_in_all / 25) << doubtful;
}

TEST(JointAssociation, IsAmbiguousWhereAnotherExplanationIsAboutAsGood) {
  expect_agreement_with_all_explanations(&JointAssociation::solve);
  expect_agreement_with_all_explanations(&JointAssociation::solve_thoroughly);
}

/// Two looks that each have one track, and together contradict each other: only the thorough answer minds.
TEST(JointAssociation, LooksWithoutAChoiceMustAgreeWhereAskedTo) {
  JointAssociation association(5, 5);
  association.begin(2, kGate, kAmbiguity);
  association.add(pairing(0, 0, {0.5, 0.0}, 0.4));
  association.add(pairing(1, 1, {-0.5, 0.0}, 0.4));
  for (const auto& match : association.solve()) EXPECT_TRUE(match.is_certain());
  association.begin(2, kGate, kAmbiguity);
  association.add(pairing(0, 0, {0.5, 0.0}, 0.4));
  association.add(pairing(1, 1, {-0.5, 0.0}, 0.4));
  for (const auto& match : association.solve_thoroughly()) EXPECT_FALSE(match.is_certain());
}

}  // namespace
}  // namespace geoloc
