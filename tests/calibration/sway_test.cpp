// SPDX-License-Identifier: Apache-2.0
#include "calibration/sway.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "calibration/drift.hpp"

namespace geoloc {
namespace {

constexpr double kPositionVariance_m2 = 0.3, kTurnVariance_rad2 = 0.02;

DriftConfig sway_config(double node_spacing_s = 3.0, double spell_s = 1.0) {
  DriftConfig config;
  config.node_spacing_s = node_spacing_s;
  config.spell_s = spell_s;
  config.sway_time_constant_s = 2.5;
  return config;
}

VehicleTime at(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

double begin_of(const SwayTimeline& sway, std::uint32_t number) {
  return seconds(sway.spell(number).begin.time_since_epoch());
}

/// Where the nodes stand on a regular grid from time 0 on.
std::uint32_t cover(SwayTimeline& sway, double time_s, double node_spacing_s = 3.0) {
  const double node = std::floor(time_s / node_spacing_s);
  return sway.cover(at(time_s), static_cast<std::uint32_t>(node), time_s / node_spacing_s - node);
}

/// All components differ.
SwayVector ramp(double from, double to) {
  return SwayVector::LinSpaced(kSwaySize, from, to);
}

TEST(SwayTimeline, HasOneSpellForEachSecond) {
  SwayTimeline sway(sway_config());
  for (int i = 0; i < 300; ++i) {
    const double time_s = 0.05 + 0.1 * i;
    const std::uint32_t number = cover(sway, time_s);
    ASSERT_EQ(number, static_cast<std::uint32_t>(time_s)) << time_s;
    EXPECT_EQ(sway.spell(number).node, number / 3) << time_s;
    EXPECT_EQ(sway.end(), number + 1) << time_s;
  }
}

/// Whatever the two lengths: the looks of a spell lie between the same two nodes, which its terms are tied
/// to.
TEST(SwayTimeline, HasNoSpellOnBothSidesOfANode) {
  struct Case {
    double node_spacing_s, spell_s, length_s;
  };
  for (const Case& c : {Case{3.0, 1.0, 1.0},
                        {5.0, 1.0, 1.0},
                        {5.0, 1.6, 5.0 / 3.0},
                        {2.0, 0.3, 2.0 / 7.0},
                        {0.5, 1.0, 0.5},
                        {0.5, 7.0, 0.5}}) {
    DriftTimeline drift(sway_config(c.node_spacing_s, c.spell_s));
    for (int i = 0; i < 1000; ++i) {
      const double time_s = 0.0301 * i;
      const NodeSpan span = drift.cover(at(time_s), 0.5);
      ASSERT_EQ(drift.sway().spell(span.spell).node, span.first) << c.node_spacing_s << " " << time_s;
      ASSERT_EQ(span.spell, static_cast<std::uint32_t>(time_s / c.length_s)) << c.spell_s << " " << time_s;
      while (drift.sway().is_full()) drift.sway().freeze_oldest();
      while (drift.size() > 6) drift.freeze_oldest();
    }
  }
}

TEST(SwayTimeline, BeginsASpellWhereTheDriftBeginsNewNodes) {
  DriftTimeline drift(sway_config());
  const NodeSpan before = drift.cover(at(1.5), 0.5);
  const NodeSpan after = drift.cover_after_step(at(1.7), 0.5, NodeVector::Ones());
  EXPECT_EQ(after.spell, before.spell + 1);
  EXPECT_EQ(drift.sway().spell(after.spell).node, after.first);
  EXPECT_EQ(drift.cover(at(100.0), 0.5).spell, after.spell + 1);
  EXPECT_EQ(drift.sway().spell(after.spell + 1).node, drift.end() - 2);
}

/// A spell that other looks have ended is not begun anew.
TEST(SwayTimeline, KeepsTimesThatRunBackInTheNewestSpell) {
  SwayTimeline sway(sway_config());
  cover(sway, 3.5);
  const std::uint32_t newest = cover(sway, 5.5);
  for (const double time_s : {5.4, 4.9, 4.1, 3.5, 3.0}) EXPECT_EQ(cover(sway, time_s), newest) << time_s;
  EXPECT_EQ(sway.cover(at(2.9), 1, -0.03), newest) << "a little before the node";
  EXPECT_EQ(sway.cover(at(6.1), 1, 1.03), newest) << "a little after the next";
  EXPECT_EQ(sway.end(), newest + 1);
  EXPECT_EQ(cover(sway, 6.1), newest + 1);
}

TEST(SwayTimeline, HasNoSpellsWhereNoneAreWanted) {
  DriftConfig config = sway_config();
  config.max_spells = 0;
  DriftTimeline drift(config);
  for (const double time_s : {0.0, 1.0, 2.5, 4.0, 100.0})
    EXPECT_EQ(drift.cover(at(time_s), 0.5).spell, kNoSpell) << time_s;
  EXPECT_EQ(drift.cover_after_step(at(101.0), 0.5, NodeVector::Ones()).spell, kNoSpell);
  EXPECT_EQ(drift.sway().size(), 0);
  EXPECT_FALSE(drift.sway().is_full());
}

TEST(SwayTimeline, IsFullWhereThereAreMoreSpellsThanMayBeEstimated) {
  for (const int most : {1, 2, 6, 8}) {
    DriftConfig config = sway_config();
    config.max_spells = most;
    SwayTimeline sway(config);
    for (int second = 0; second < 50; ++second) {
      cover(sway, second + 0.5);
      EXPECT_EQ(sway.is_full(), second >= most) << most;
      while (sway.is_full()) sway.freeze_oldest();
      EXPECT_EQ(sway.size(), std::min(most, second + 1));
      EXPECT_EQ(sway.end(), static_cast<std::uint32_t>(second + 1));
    }
  }
}

/// Covariance of the component over all spells by the definition of the prior: each is transition times the
/// one before and an independent rest.
Eigen::MatrixXd prior_covariance_of(const SwayTimeline& sway, int component) {
  Eigen::MatrixXd from_rests = Eigen::MatrixXd::Zero(sway.size(), sway.size());
  Eigen::VectorXd variance(sway.size());
  for (Eigen::Index k = 0; k < sway.size(); ++k) {
    const auto number = sway.begin() + static_cast<std::uint32_t>(k);
    if (k > 0) from_rests.row(k) = sway.spell(number).transition * from_rests.row(k - 1);
    from_rests(k, k) = 1.0;
    variance[k] = 1.0 / sway.information(number)[component];
  }
  return from_rests * variance.asDiagonal() * from_rests.transpose();
}

/// variance exp(-|t1 - t2| / time constant) between spells that begin at t1 and t2, after pauses too.
TEST(SwayTimeline, IsAStationaryGaussMarkovProcess) {
  SwayTimeline sway(sway_config());
  sway.set_variance(kPositionVariance_m2, kTurnVariance_rad2);
  for (const double time_s : {10.0, 11.4, 12.3, 13.2, 14.9, 20.0, 60.0, 61.1}) cover(sway, time_s);
  ASSERT_EQ(sway.size(), 8);
  for (int i = 0; i < kSwaySize; ++i) {
    const double expected = i < 2 ? kPositionVariance_m2 : kTurnVariance_rad2;
    const Eigen::MatrixXd covariance = prior_covariance_of(sway, i);
    for (std::uint32_t a = 0; a < 8; ++a) {
      for (std::uint32_t b = 0; b < 8; ++b) {
        const double apart_s = std::abs(begin_of(sway, a) - begin_of(sway, b));
        EXPECT_NEAR(covariance(a, b), expected * std::exp(-apart_s / 2.5), 1e-12) << a << " " << b;
      }
    }
  }
}

TEST(SwayTimeline, HasAPriorThatIsFiniteWhereThereIsNoSway) {
  SwayTimeline sway(sway_config());
  cover(sway, 0.5);
  cover(sway, 1.5);
  for (const std::uint32_t number : {0U, 1U}) {
    EXPECT_TRUE(sway.information(number).allFinite());
    EXPECT_GT(sway.information(number).minCoeff(), 1e9);
  }
}

TEST(SwayTimeline, ExpectsOfANewSpellWhatTheLastOneLeaves) {
  SwayTimeline sway(sway_config());
  cover(sway, 0.0);
  sway.spell(0).mean = ramp(2.0, -4.0);
  cover(sway, 1.2);
  EXPECT_LT((sway.spell(1).mean - std::exp(-1.2 / 2.5) * ramp(2.0, -4.0)).norm(), 1e-12);
  EXPECT_EQ(sway.spell(1).prior_mean, SwayVector(SwayVector::Zero()));
}

/// The spell after a frozen one has the distribution of the process given the frozen value.
TEST(SwayTimeline, GoesOnFromTheValueThatASpellIsFrozenAt) {
  SwayTimeline sway(sway_config());
  sway.set_variance(kPositionVariance_m2, kTurnVariance_rad2);
  for (const double time_s : {0.0, 1.2, 2.0}) cover(sway, time_s);
  const SwayVector frozen = ramp(0.7, -0.2);
  sway.spell(0).mean = frozen;
  sway.freeze_oldest();
  EXPECT_EQ(sway.begin(), 1U);
  EXPECT_EQ(sway.size(), 2);
  const double kept = std::exp(-1.2 / 2.5), kept_later = std::exp(-0.8 / 2.5);
  EXPECT_LT((sway.spell(1).prior_mean - kept * frozen).norm(), 1e-12);
  for (int i = 0; i < kSwaySize; ++i) {
    const double whole = i < 2 ? kPositionVariance_m2 : kTurnVariance_rad2;
    const double variance = whole * (1.0 - kept * kept);
    const Eigen::MatrixXd covariance = prior_covariance_of(sway, i);
    EXPECT_NEAR(covariance(0, 0), variance, 1e-12);
    EXPECT_NEAR(covariance(0, 1), kept_later * variance, 1e-12);
    EXPECT_NEAR(covariance(1, 1), whole * (1.0 - std::pow(kept * kept_later, 2)), 1e-12);
  }
  // One that nothing was said of leaves the next as far known as the process says.
  sway.spell(1).mean = sway.spell(1).prior_mean;
  sway.freeze_oldest();
  EXPECT_LT((sway.spell(2).prior_mean - kept * kept_later * frozen).norm(), 1e-12);
}

TEST(SwayTimeline, RemembersTheFrozenSpellsOfMinutes) {
  SwayTimeline sway(sway_config());
  for (int second = 0; second < 1000; ++second) {
    const std::uint32_t number = cover(sway, second + 0.5);
    sway.spell(number).mean = SwayVector::Constant(second);
    while (sway.is_full()) sway.freeze_oldest();
    for (std::uint32_t back = 0; back < 250 && back <= number; ++back)
      ASSERT_EQ(sway.spell(number - back).mean[3], number - back);
  }
  EXPECT_TRUE(sway.is_frozen(sway.begin() - 1));
  EXPECT_FALSE(sway.is_frozen(sway.begin()));
  EXPECT_FALSE(sway.is_frozen(kNoSpell));
}

TEST(SwayTimeline, BeginsAnewWhenTheDriftIsForgotten) {
  DriftTimeline drift(sway_config());
  SwayTimeline& sway = drift.sway();
  sway.set_variance(kPositionVariance_m2, kTurnVariance_rad2);
  for (const double time_s : {0.0, 1.2, 2.0})
    sway.spell(drift.cover(at(time_s), 0.5).spell).mean = ramp(1, 2);
  drift.clear();
  EXPECT_EQ(sway.size(), 0);
  const std::uint32_t first = drift.cover(at(2.5), 0.5).spell;
  EXPECT_EQ(first, 3U) << "numbers go on";
  EXPECT_EQ(sway.size(), 1);
  EXPECT_EQ(sway.spell(first).mean, SwayVector(SwayVector::Zero()));
  EXPECT_EQ(sway.spell(first).prior_mean, SwayVector(SwayVector::Zero()));
  EXPECT_LT((sway.information(first).cwiseInverse() - sway.variance()).norm(), 1e-12);
}

}  // namespace
}  // namespace geoloc
