// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr double kSigmaPosition_m = 0.5;

DriftConfig config_with(double spacing_s, int max_nodes = 36) {
  DriftConfig config;
  config.node_spacing_s = spacing_s;
  config.max_nodes = max_nodes;
  return config;
}

constexpr int kUp = 2;

/// 1-sigma of a node's component, in the state in which it wanders for ever.
double sigma_of(const DriftConfig& config, int i) {
  if (i < 2) return kSigmaPosition_m;
  return i == kUp ? config.sigma_up_m : config.sigma_yaw_deg * kPi / 180.0;
}

double time_constant_of(const DriftConfig& config, int i) {
  if (i < 2) return config.position_time_constant_s;
  return i == kUp ? config.up_time_constant_s : config.yaw_time_constant_s;
}

/// Shares of the variance that wander and ripple: of the height and the yaw all wanders.
double wandering_share_of(const DriftConfig& config, int i) {
  return i < 2 ? 1.0 - config.ripple_share : 1.0;
}

/// Covariance of a component at two times so far apart, in the state in which it has wandered for ever.
double covariance_of(const DriftConfig& config, int i, double apart_s) {
  const double share = wandering_share_of(config, i);
  return std::pow(sigma_of(config, i), 2) *
         (share * std::exp(-std::abs(apart_s) / time_constant_of(config, i)) +
          (1.0 - share) * std::exp(-std::abs(apart_s) / config.ripple_time_constant_s));
}

/// What five seconds leave of each component's wandering.
NodeVector kept_of(const DriftConfig& config) {
  NodeVector kept;
  for (int i = 0; i < kNodeSize; ++i) kept[i] = std::exp(-5.0 / time_constant_of(config, i));
  return kept;
}

/// All components differ.
NodeVector ramp(double from, double to) {
  return NodeVector::LinSpaced(kNodeSize, from, to);
}

/// The components' time constants and sigmas all differ.
DriftConfig distinct_config() {
  DriftConfig config = config_with(5.0);
  config.up_time_constant_s = 17.0;
  config.sigma_up_m = 0.3;
  return config;
}

NodeSpan cover(DriftTimeline& drift, double time_s) {
  return drift.cover(VehicleTime{from_seconds(time_s)}, kSigmaPosition_m);
}

double time_of(const DriftTimeline& drift, std::uint32_t number) {
  return seconds(drift.node(number).time.time_since_epoch());
}

/// Covariance of all nodes' ripple, by its definition as below.
Eigen::MatrixXd ripple_covariance_of(const DriftTimeline& drift) {
  const Eigen::Index size = drift.size();
  Eigen::MatrixXd from_rests = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd variance(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto number = drift.begin() + static_cast<std::uint32_t>(k);
    if (k > 0) from_rests.row(k) = drift.node(number).ripple_transition * from_rests.row(k - 1);
    from_rests(k, k) = 1.0;
    variance[k] = drift.ripple_variance(number);
  }
  return from_rests * variance.asDiagonal() * from_rests.transpose();
}

/// Covariance of all nodes' component `i` by the definition of the prior: each is transition times the one
/// before and an independent rest of variance 1 / information.
Eigen::MatrixXd prior_covariance_of(const DriftTimeline& drift, int i) {
  const Eigen::Index size = drift.size();
  Eigen::MatrixXd from_rests = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd variance(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto number = drift.begin() + static_cast<std::uint32_t>(k);
    if (k > 0) from_rests.row(k) = drift.node(number).transition[i] * from_rests.row(k - 1);
    from_rests(k, k) = 1.0;
    variance[k] = 1.0 / drift.information(number)[i];
  }
  const Eigen::MatrixXd wandering = from_rests * variance.asDiagonal() * from_rests.transpose();
  return i < 2 ? Eigen::MatrixXd(wandering + ripple_covariance_of(drift)) : wandering;
}

/// Stationary first-order Gauss-Markov processes, sigma^2 exp(-|t1 - t2| / time constant), at any spacing;
/// the position is the sum of two.
TEST(DriftTimeline, WandersAsStationaryGaussMarkovProcesses) {
  DriftConfig config = distinct_config();
  config.node_spacing_s = 4.0;
  DriftTimeline drift(config);
  for (const double time_s : {10.0, 13.0, 15.0, 21.0, 60.0, 63.0, 66.0}) cover(drift, time_s);
  for (int i = 0; i < kNodeSize; ++i) {
    const Eigen::MatrixXd covariance = prior_covariance_of(drift, i);
    for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
      for (Eigen::Index b = 0; b < covariance.cols(); ++b) {
        const double apart_s =
            time_of(drift, static_cast<std::uint32_t>(a)) - time_of(drift, static_cast<std::uint32_t>(b));
        EXPECT_NEAR(covariance(a, b), covariance_of(config, i, apart_s), 1e-12);
      }
      EXPECT_NEAR(drift.stationary_variance(static_cast<std::uint32_t>(a))[i], covariance(a, a), 1e-12);
    }
  }
}

TEST(DriftTimeline, ScalesTheWanderingOfThePositionAndNothingElse) {
  DriftTimeline drift{DriftConfig{}}, scaled{DriftConfig{}};
  EXPECT_EQ(drift.position_scale(), 1.0);
  for (DriftTimeline* one : {&drift, &scaled}) {
    cover(*one, 0.0);
    cover(*one, 6.0);
  }
  scaled.set_position_scale(3.0);
  EXPECT_EQ(scaled.position_scale(), 3.0);
  for (int i = 0; i < kNodeSize; ++i) {
    EXPECT_TRUE(
        prior_covariance_of(scaled, i).isApprox((i < 2 ? 9.0 : 1.0) * prior_covariance_of(drift, i), 1e-12));
  }
}

/// By the covariance of the process, at many times between two nodes.
TEST(DriftTimeline, KnowsWhatRipplesBesideItsStraightLines) {
  for (const double spacing_s : {0.5, 3.0, 10.0}) {
    const DriftConfig config = config_with(spacing_s);
    DriftTimeline drift(config);
    EXPECT_EQ(drift.ripple_between_nodes_m2(), 0.0);
    for (const double spacings : {0.1, 1.1, 2.1}) cover(drift, spacings * spacing_s);
    drift.set_position_scale(0.7);
    const auto covariance = [&](double share) {
      return std::exp(-std::abs(share) * spacing_s / config.ripple_time_constant_s);
    };
    constexpr int kTimes = 2000;
    double sum = 0.0;
    for (int i = 0; i < kTimes; ++i) {
      const double second = (i + 0.5) / kTimes, first = 1.0 - second;
      sum += 1.0 + first * first + second * second + 2.0 * first * second * covariance(1.0) -
             2.0 * first * covariance(second) - 2.0 * second * covariance(first);
    }
    const double ripple_m2 = config.ripple_share * std::pow(0.7 * kSigmaPosition_m, 2);
    EXPECT_NEAR(drift.ripple_between_nodes_m2(), ripple_m2 * sum / kTimes, 1e-6 * ripple_m2) << spacing_s;
  }
}

/// New nodes that differ from the ones before by the step's variance besides, however the position wanders.
TEST(DriftTimeline, BeginsNewNodesWhereTheStateStepped) {
  const NodeVector step_variance(0.3, 0.3, 0.0, 0.02);
  for (const double scale : {0.1, 1.0, 3.0}) {
    DriftTimeline drift(distinct_config()), smooth(distinct_config());
    for (DriftTimeline* one : {&drift, &smooth}) {
      cover(*one, 10.0);
      one->set_position_scale(scale);
      one->node(1).mean = ramp(1.0, 2.0);
    }
    const NodeSpan span =
        drift.cover_after_step(VehicleTime{from_seconds(12.0)}, kSigmaPosition_m, step_variance);
    smooth.cover_after_step(VehicleTime{from_seconds(12.0)}, kSigmaPosition_m, NodeVector::Zero());
    ASSERT_EQ(drift.size(), 4);
    EXPECT_EQ(span.first, 2U);
    EXPECT_LE(time_of(drift, 2), 12.0);
    EXPECT_GE(time_of(drift, 3), 12.0);
    EXPECT_TRUE(drift.node(2).is_after_step());
    EXPECT_FALSE(drift.node(3).is_after_step());
    EXPECT_FALSE(smooth.node(2).is_after_step());
    const NodeVector added = drift.information(2).cwiseInverse() - smooth.information(2).cwiseInverse();
    EXPECT_LT((added - step_variance).norm(), 1e-12) << "scale " << scale;
    EXPECT_TRUE(drift.node(2).mean.isApprox(drift.node(2).transition.cwiseProduct(ramp(1.0, 2.0)), 1e-12));
    EXPECT_EQ(cover(drift, 12.1).first, 2U);
    EXPECT_EQ(cover(drift, 11.9).first, 2U) << "a time that runs back a little goes on";
  }
}

TEST(DriftTimeline, BeginsAsUsualWhereItsFirstTimeFollowsAStep) {
  DriftTimeline drift{DriftConfig{}};
  const NodeSpan span = drift.cover_after_step(VehicleTime{from_seconds(3.0)}, 0.5, NodeVector::Ones());
  EXPECT_EQ(span.first, 0U);
  EXPECT_EQ(drift.size(), 2);
  EXPECT_FALSE(drift.node(0).is_after_step());
}

TEST(DriftTimeline, CoversEveryTimeByTheTwoNodesAroundIt) {
  DriftTimeline drift(config_with(5.0));
  for (const double time_s :
       {100.0, 101.0, 104.99, 105.0, 105.01, 110.0, 110.5, 500.0, 503.0, 505.0, 505.5}) {
    const NodeSpan span = cover(drift, time_s);
    ASSERT_EQ(span.first + 2, drift.end());
    EXPECT_GE(span.weight_of_second, 0.0);
    EXPECT_LE(span.weight_of_second, 1.0);
    const double mean_s = (1 - span.weight_of_second) * time_of(drift, span.first) +
                          span.weight_of_second * time_of(drift, span.first + 1);
    EXPECT_NEAR(mean_s, time_s, 1e-6);
  }
}

TEST(DriftTimeline, IsAStraightLineBetweenNodes) {
  DriftTimeline drift(config_with(5.0));
  const NodeSpan span = cover(drift, 10.0);
  drift.node(span.first).mean = ramp(1.0, -2.0);
  drift.node(span.first + 1).mean = ramp(2.0, 6.0);
  EXPECT_LT((drift.at(cover(drift, 10.0)) - ramp(1.0, -2.0)).norm(), 1e-12);
  EXPECT_LT((drift.at(cover(drift, 11.25)) - ramp(1.25, 0.0)).norm(), 1e-12);
  EXPECT_LT((drift.at(cover(drift, 15.0)) - ramp(2.0, 6.0)).norm(), 1e-12);
}

TEST(DriftTimeline, HasNodesAtTheSpacingAndNoneForAPause) {
  DriftTimeline drift(config_with(5.0));
  std::vector<double> times;
  for (const double time_s : {100.0, 103.0, 106.0, 500.0}) cover(drift, time_s);
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
    times.push_back(time_of(drift, number));
  EXPECT_EQ(times, (std::vector<double>{100.0, 105.0, 110.0, 500.0, 505.0}));
}

TEST(DriftTimeline, ATimeJustAfterTheLastNodeContinuesTheGrid) {
  DriftTimeline drift(config_with(5.0));
  cover(drift, 0.0);
  cover(drift, 10.0);  // no longer after the last node than the spacing
  EXPECT_EQ(drift.size(), 3);
  EXPECT_EQ(time_of(drift, 2), 10.0);
}

TEST(DriftTimeline, ExpectsOfANewNodeWhatTheLastOneLeaves) {
  const DriftConfig config = distinct_config();
  DriftTimeline drift(config);
  cover(drift, 0.0);
  drift.node(1).mean = ramp(2.0, -4.0);
  cover(drift, 6.0);
  EXPECT_LT((drift.node(2).mean - kept_of(config).cwiseProduct(ramp(2.0, -4.0))).norm(), 1e-12);
  EXPECT_EQ(drift.node(2).prior_mean, NodeVector(NodeVector::Zero()));
}

TEST(DriftTimeline, BeginsAnewWhenTheClockRunsBack) {
  DriftTimeline drift{DriftConfig{}};
  cover(drift, 100.0);
  drift.node(1).mean = NodeVector::Ones();
  const NodeSpan span = cover(drift, 3.0);
  EXPECT_EQ(drift.node(span.first).transition, NodeVector(NodeVector::Zero()));
  EXPECT_EQ(drift.node(span.first).mean, NodeVector(NodeVector::Zero()));
  for (int i = 0; i < kNodeSize; ++i)
    EXPECT_NEAR(1.0 / drift.node(span.first).information[i],
                wandering_share_of(DriftConfig{}, i) * std::pow(sigma_of(DriftConfig{}, i), 2), 1e-12);
  EXPECT_EQ(time_of(drift, span.first), 3.0);
  EXPECT_EQ(drift.size(), 4);
}

/// The node after a frozen one has the distribution of the process given the frozen value.
TEST(DriftTimeline, GoesOnFromTheValueThatANodeIsFrozenAt) {
  const DriftConfig config = distinct_config();
  DriftTimeline drift(config);
  cover(drift, 0.0);
  cover(drift, 6.0);
  const NodeVector frozen = ramp(0.7, -0.2);
  drift.node(0).mean = frozen;
  drift.freeze_oldest();
  EXPECT_EQ(drift.begin(), 1U);
  EXPECT_EQ(drift.size(), 2);
  const NodeVector kept = kept_of(config);
  EXPECT_LT((drift.node(1).prior_mean - kept.cwiseProduct(frozen)).norm(), 1e-12);
  for (int i = 0; i < kNodeSize; ++i) {
    const double share = wandering_share_of(config, i), sigma2 = std::pow(sigma_of(config, i), 2);
    const double variance = share * sigma2 * (1.0 - kept[i] * kept[i]);
    const double ripple = (1.0 - share) * sigma2 * (1.0 - std::exp(-10.0 / config.ripple_time_constant_s));
    EXPECT_NEAR(1.0 / drift.information(1)[i], variance, 1e-12);
    EXPECT_NEAR(prior_covariance_of(drift, i)(0, 0), variance + ripple, 1e-12);
  }
}

TEST(DriftTimeline, KeepsAsManyNodesAsItMayWhateverTheirNumbers) {
  for (const int most : {4, 5, 6, 7, 14, 15}) {
    DriftTimeline drift(config_with(1.0, most));
    for (int i = 0; i < 100; ++i) {
      const NodeSpan span = cover(drift, 0.9 * i);
      drift.node(span.first + 1).mean = NodeVector::Constant(span.first + 1.0);
      while (drift.size() > most) drift.freeze_oldest();
      for (std::uint32_t number = std::max(1U, drift.begin()); number != drift.end(); ++number)
        ASSERT_EQ(drift.node(number).mean.x(), number) << most;
    }
    EXPECT_EQ(drift.size(), most);
  }
}

// --- Thinning: older nodes make room for new ones.

/// Leaves out as many as need be.
void thin_to(DriftTimeline& drift, int most) {
  while (drift.size() > most) {
    const auto node = drift.next_to_thin();
    ASSERT_TRUE(node);
    drift.thin(*node);
  }
}

/// Nodes in order of time, so many seconds before the newest.
std::vector<double> ages_of(const DriftTimeline& drift) {
  std::vector<double> ages;
  for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
    ages.push_back(time_of(drift, drift.end() - 1) - time_of(drift, number));
  return ages;
}

TEST(ThinnedDrift, ReachesBackToTheStartOfAnHourWithAsManyNodesAsItMay) {
  const DriftConfig config;
  DriftTimeline drift(config);
  for (int second = 0; second <= 3600; ++second) {
    cover(drift, second);
    thin_to(drift, config.max_nodes);
    ASSERT_LE(drift.size(), config.max_nodes);
    ASSERT_EQ(time_of(drift, drift.begin()), 0.0);
  }
  EXPECT_EQ(drift.size(), config.max_nodes);
}

/// The node that goes is the one whose neighbours' ages have the least ratio, so that this is no more than
/// the geometric mean over all that may go. The product of the ratios is that of the two oldest ages over
/// that of the two youngest, of one and two spacings.
double largest_gap_per_age(const DriftConfig& config, double duration_s) {
  const double ages = duration_s / config.node_spacing_s;
  return std::pow(ages * ages / 2.0, 1.0 / (config.max_nodes - 2)) - 1.0;
}

TEST(ThinnedDrift, HasNodesTheFartherApartTheOlderTheyAre) {
  const DriftConfig config;
  DriftTimeline drift(config);
  const double most_per_age = largest_gap_per_age(config, 3600.0 + config.node_spacing_s);
  ASSERT_LT(most_per_age, 0.9);
  for (int second = 0; second <= 3600; ++second) {
    cover(drift, second);
    thin_to(drift, config.max_nodes);
    const std::vector<double> ages = ages_of(drift);
    for (std::size_t i = 1; i < ages.size(); ++i) {
      const double apart_s = ages[i - 1] - ages[i];
      EXPECT_GE(apart_s, config.node_spacing_s - 1e-9);
      EXPECT_LE(apart_s, std::max(config.node_spacing_s + 1e-9, most_per_age * ages[i]))
          << second << " s, node " << i;
    }
  }
  const std::vector<double> ages = ages_of(drift);
  const auto gap_s = [&](std::size_t i) { return ages[i] - ages[i + 1]; };
  for (std::size_t i = 0; i + 5 < ages.size(); ++i) EXPECT_GE(gap_s(i), gap_s(i + 4)) << "node " << i;
  EXPECT_NEAR(gap_s(ages.size() - 2), config.node_spacing_s, 1e-9);
  EXPECT_GT(gap_s(0), 100.0 * config.node_spacing_s);
}

/// So looks and readings of the last seconds may be taken back, or come late.
TEST(ThinnedDrift, LeavesTheNewestNodesWhereTheyAre) {
  const DriftConfig config;
  DriftTimeline drift(config), whole(config_with(config.node_spacing_s, 2000));
  for (int i = 0; i <= 1000; ++i) {
    const double time_s = 0.7 * i;
    const NodeSpan span = cover(drift, time_s), expected = cover(whole, time_s);
    for (DriftTimeline* one : {&drift, &whole})
      one->node(span.first + 1).mean = ramp(std::sin(time_s), std::cos(time_s));
    thin_to(drift, config.max_nodes);
    ASSERT_EQ(span.first, expected.first);
    ASSERT_EQ(span.weight_of_second, expected.weight_of_second);
    ASSERT_EQ(drift.at(span), whole.at(expected));
    ASSERT_GE(drift.end() - drift.begin_of_fine(), std::min(drift.end(), 4U));
    for (std::uint32_t number = drift.begin_of_fine(); number != drift.end(); ++number) {
      ASSERT_EQ(drift.node(number).time, whole.node(number).time);
      ASSERT_EQ(drift.node(number).mean, whole.node(number).mean);
    }
  }
}

/// Nodes with a step between them, and a mean that tells them apart.
class DriftToThin : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const double time_s : {0.0, 6.0, 11.0, 16.0}) cover(drift_, time_s);
    drift_.cover_after_step(VehicleTime{from_seconds(22.0)}, kSigmaPosition_m, kStep);
    for (const double time_s : {27.0, 33.0, 37.0, 80.0, 86.0, 91.0}) cover(drift_, time_s);
    for (std::uint32_t number = 0; number != drift_.end(); ++number)
      drift_.node(number).mean = ramp(std::sin(number), std::cos(3.0 * number));
    drift_.set_position_scale(1.7);
  }

  /// As next_to_thin() would, of any node.
  ThinnedNode thinned(std::uint32_t number) const {
    const DriftNode &before = drift_.node(number - 1), &here = drift_.node(number),
                    &after = drift_.node(number + 1);
    const double weight = seconds(here.time - before.time) / seconds(after.time - before.time);
    return {number, weight, here.mean - (1.0 - weight) * before.mean - weight * after.mean};
  }

  /// Nodes that were there at first, in order, by when they are.
  std::vector<double> times() const {
    std::vector<double> times;
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      times.push_back(time_of(drift_, number));
    return times;
  }

  /// Without the rows and columns of a node.
  static Eigen::MatrixXd without(const Eigen::MatrixXd& covariance, Eigen::Index gone) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
      if (i != gone) kept.push_back(i);
    }
    return covariance(kept, kept);
  }

  const NodeVector kStep{0.3, 0.2, 0.1, 0.02};
  DriftTimeline drift_{distinct_config()};
};

/// Whichever goes, and one after another, of the ones before a step too.
TEST_F(DriftToThin, ExpectsOfTheNodesThatRemainWhatItDid) {
  while (const auto node = drift_.next_to_thin()) {
    std::vector<Eigen::MatrixXd> expected;
    for (int i = 0; i < kNodeSize; ++i)
      expected.push_back(without(prior_covariance_of(drift_, i), node->number - drift_.begin()));
    drift_.thin(*node);
    for (int i = 0; i < kNodeSize; ++i) {
      EXPECT_LT((prior_covariance_of(drift_, i) - expected[static_cast<std::size_t>(i)]).norm(), 1e-12)
          << "node " << node->number << ", component " << i;
    }
  }
  EXPECT_LT(drift_.size(), 9) << "some were left out";
}

/// Steps and what was left out make no difference: it is that of the process.
TEST_F(DriftToThin, IsExpectedToWanderAsFarAtAnyTime) {
  while (const auto node = drift_.next_to_thin()) drift_.thin(*node);
  for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
    for (int i = 0; i < kNodeSize; ++i) {
      const double scale = i < 2 ? drift_.position_scale() : 1.0;
      EXPECT_NEAR(drift_.stationary_variance(number)[i], std::pow(scale * sigma_of(distinct_config(), i), 2),
                  1e-12);
    }
  }
}

/// A vehicle that reboots begins a new clock and a new drift: between its nodes and those before, there is no
/// line, and no time.
TEST(ThinnedDrift, LeavesOutNoNodeOnEitherSideOfAClockThatRanBack) {
  for (const double begin_again_s : {0.0, 2.9, 41.0, 83.0}) {
    DriftTimeline drift(config_with(5.0));
    for (double time_s = 0.0; time_s < 100.0; time_s += 1.0) cover(drift, time_s);
    for (int second = 0; second < 20; ++second) cover(drift, begin_again_s + second);
    while (const auto node = drift.next_to_thin()) {
      ASSERT_GT(node->weight_of_next, 0.0);
      ASSERT_LT(node->weight_of_next, 1.0);
      drift.thin(*node);
    }
    std::vector<double> times;
    for (std::uint32_t number = drift.begin(); number != drift.end(); ++number)
      times.push_back(time_of(drift, number));
    const std::vector<double> kept{0.0, 100.0, begin_again_s, begin_again_s + 15.0, begin_again_s + 20.0};
    ASSERT_EQ(times.size(), kept.size()) << "the oldest, both sides of the break and the newest two";
    for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_NEAR(times[i], kept[i], 1e-6);
  }
}

/// After a frozen node the prior's mean is what that leaves, which further nodes inherit.
TEST_F(DriftToThin, ExpectsTheSameMeanOfTheNodesThatRemain) {
  drift_.freeze_oldest();
  const auto prior_means = [this] {
    std::map<double, NodeVector> means;
    NodeVector mean = NodeVector::Zero();
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
      mean = drift_.node(number).prior_mean + drift_.node(number).transition.cwiseProduct(mean);
      means[time_of(drift_, number)] = mean;
    }
    return means;
  };
  const auto expected = prior_means();
  ASSERT_GT(expected.begin()->second.norm(), 0.1);
  while (const auto node = drift_.next_to_thin()) {
    drift_.thin(*node);
    for (const auto& [time_s, mean] : prior_means()) EXPECT_LT((mean - expected.at(time_s)).norm(), 1e-12);
  }
}

TEST_F(DriftToThin, KeepsTheNodesOnBothSidesOfAStepTheOldestAndTheNewestTwo) {
  const std::vector<double> before = times();
  const std::uint32_t end = drift_.end();
  std::uint32_t step = drift_.begin();
  while (!drift_.node(step).is_after_step()) ++step;
  std::vector<double> kept{before.front(), before[step - 1], before[step]};
  kept.insert(kept.end(), before.end() - 2, before.end());
  while (const auto node = drift_.next_to_thin()) drift_.thin(*node);
  EXPECT_EQ(drift_.end(), end);
  const std::vector<double> after = times();
  for (const double time_s : kept) EXPECT_EQ(std::count(after.begin(), after.end(), time_s), 1) << time_s;
  EXPECT_LT(after.size(), before.size());
  std::uint32_t steps = 0;
  for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number) {
    if (!drift_.node(number).is_after_step()) continue;
    ++steps;
    EXPECT_EQ(time_of(drift_, number), before[step]);
    EXPECT_EQ(drift_.node(number).step_variance, kStep);
  }
  EXPECT_EQ(steps, 1U);
}

/// d = (1 - w) d(before) + w d(after) + deviation, with w by when it is.
TEST_F(DriftToThin, SaysWhatTakesThePlaceOfANode) {
  const auto node = drift_.next_to_thin();
  ASSERT_TRUE(node);
  const double w = node->weight_of_next;
  const std::uint32_t n = node->number;
  EXPECT_NEAR((1.0 - w) * time_of(drift_, n - 1) + w * time_of(drift_, n + 1), time_of(drift_, n), 1e-9);
  const NodeVector value =
      (1.0 - w) * drift_.node(n - 1).mean + w * drift_.node(n + 1).mean + node->deviation;
  EXPECT_LT((value - drift_.node(n).mean).norm(), 1e-12);
}

TEST_F(DriftToThin, CallsTheNodesBeforeByANumberHigherByOne) {
  for (const std::uint32_t gone : {3U, 8U, 6U}) {
    std::map<std::uint32_t, double> expected;
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      if (number != gone) expected[number < gone ? number + 1 : number] = time_of(drift_, number);
    drift_.thin(thinned(gone));
    std::map<std::uint32_t, double> seen;
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      seen[number] = time_of(drift_, number);
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(drift_.begin_of_fine(), gone == 3 ? 4U : 9U);
  }
}

TEST(ThinnedDrift, HasNothingToThinWhereThereIsNoneBetweenOthers) {
  DriftTimeline drift{DriftConfig{}};
  for (const double time_s : {0.0, 4.0}) {
    cover(drift, time_s);
    EXPECT_FALSE(drift.next_to_thin());
  }
  cover(drift, 7.0);  // four nodes; the newest two are in use
  ASSERT_EQ(drift.size(), 4);
  EXPECT_EQ(drift.next_to_thin()->number, 1U);
}

}  // namespace
}  // namespace geoloc
