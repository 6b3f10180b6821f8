// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
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

/// What five seconds leave of each component.
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
  return from_rests * variance.asDiagonal() * from_rests.transpose();
}

/// A stationary first-order Gauss-Markov process: sigma^2 exp(-|t1 - t2| / time constant), at any spacing.
TEST(DriftTimeline, WandersAsAStationaryGaussMarkovProcess) {
  DriftConfig config = distinct_config();
  config.node_spacing_s = 4.0;
  DriftTimeline drift(config);
  for (const double time_s : {10.0, 13.0, 15.0, 21.0, 60.0, 63.0, 66.0}) cover(drift, time_s);
  for (int i = 0; i < kNodeSize; ++i) {
    const double sigma = sigma_of(config, i), constant_s = time_constant_of(config, i);
    const Eigen::MatrixXd covariance = prior_covariance_of(drift, i);
    for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
      for (Eigen::Index b = 0; b < covariance.cols(); ++b) {
        const double apart_s =
            time_of(drift, static_cast<std::uint32_t>(a)) - time_of(drift, static_cast<std::uint32_t>(b));
        EXPECT_NEAR(covariance(a, b), sigma * sigma * std::exp(-std::abs(apart_s) / constant_s),
                    1e-12 * sigma * sigma);
      }
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
    EXPECT_NEAR(1.0 / drift.node(span.first).information[i], std::pow(sigma_of(DriftConfig{}, i), 2), 1e-12);
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
    const double variance = std::pow(sigma_of(config, i), 2) * (1.0 - kept[i] * kept[i]);
    EXPECT_NEAR(1.0 / drift.information(1)[i], variance, 1e-12);
    EXPECT_NEAR(prior_covariance_of(drift, i)(0, 0), variance, 1e-12);
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

}  // namespace
}  // namespace geoloc
