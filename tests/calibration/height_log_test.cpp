// SPDX-License-Identifier: Apache-2.0
#include "calibration/height_log.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

namespace geoloc {
namespace {

class HeightLogs : public ::testing::Test {
 protected:
  static DriftConfig config() {
    DriftConfig config;
    config.node_spacing_s = 5.0;
    return config;
  }

  NodeSpan at(double time_s) { return drift_.cover(VehicleTime{from_seconds(time_s)}, 0.5); }

  /// Heights of the nodes, by number.
  using Heights = std::map<std::uint32_t, double>;

  /// What is left of an observation where the height is known [m].
  static double residual(const HeightObservation& seen, const Heights& heights) {
    const double second = seen.span.weight_of_second;
    return seen.value_m - (1.0 - second) * heights.at(seen.span.first) -
           second * heights.at(seen.span.first + 1);
  }

  DriftTimeline drift_{config()};
  HeightLog log_{config().max_nodes};
};

/// However many there are over the same ground.
TEST_F(HeightLogs, CountReadingsBetweenTheSameNodesAsOneThatIsTheirMean) {
  for (int i = 0; i < 50; ++i) log_.add(at(0.1 * i), i % 2 == 0 ? 3.0 : 5.0, 4.0);
  ASSERT_EQ(log_.observations().size(), 1U);
  EXPECT_NEAR(log_.observations()[0].value_m, 4.0, 1e-9);
  EXPECT_NEAR(log_.observations()[0].information, 0.25, 1e-9);
  EXPECT_NEAR(log_.observations()[0].span.weight_of_second, 0.1 * 24.5 / 5.0, 1e-9);
  log_.add(at(5.1), 7.0, 1.0);
  ASSERT_EQ(log_.observations().size(), 2U);
  EXPECT_EQ(log_.observations()[1].value_m, 7.0);
}

/// The node's estimate is taken out of what is left.
TEST_F(HeightLogs, KeepWhatFrozenNodesLeaveOfTheConstantHeight) {
  at(0.0);
  log_.add(at(1.0), 3.0, 0.25);
  log_.add(at(6.0), 9.0, 0.25);
  drift_.node(0).mean[kNodeUp] = 0.5;
  drift_.node(1).mean[kNodeUp] = 1.0;
  log_.freeze_oldest(drift_);
  ASSERT_EQ(log_.observations().size(), 1U);
  EXPECT_NEAR(log_.constant().information, 4.0, 1e-12);
  EXPECT_NEAR(log_.constant().vector, 4.0 * (3.0 - (0.8 * 0.5 + 0.2 * 1.0)), 1e-12);
}

TEST_F(HeightLogs, AreNotSurerInFlightsOfHours) {
  for (double time_s = 0.0; time_s < 4000.0; time_s += 1.0) {
    log_.add(at(time_s), 2.0, 0.5);
    while (drift_.size() > config().max_nodes) {
      log_.freeze_oldest(drift_);
      drift_.freeze_oldest();
    }
  }
  EXPECT_NEAR(log_.constant().information, 25.0, 1e-9);
  EXPECT_NEAR(log_.constant().vector / log_.constant().information, 2.0, 1e-9);
  EXPECT_LE(log_.observations().size(), static_cast<std::size_t>(config().max_nodes));
}

/// For any heights, with that of the node on the line between its neighbours, but for what it deviates by.
class ThinnedHeightLogs : public HeightLogs {
 protected:
  void SetUp() override {
    for (const double time_s : {2.0, 7.0, 13.0, 18.0, 23.0}) at(time_s);
  }

  static constexpr std::uint32_t kThinned = 2;
  ThinnedNode thinned_{kThinned, 0.3, NodeVector(9.0, 9.0, 0.8, 9.0)};
  Heights before_{{0, 0.7}, {1, -1.1}, {2, 0.7 * -1.1 + 0.3 * 2.3 + 0.8}, {3, 2.3}, {4, -0.4}, {5, 0.9}};
  Heights after_{{1, 0.7}, {2, -1.1}, {3, 2.3}, {4, -0.4}, {5, 0.9}};
};

TEST_F(ThinnedHeightLogs, SayTheSameOfHeightsOnTheLineThatStandsForTheNode) {
  for (const std::uint32_t first : {0U, 1U, 2U, 3U, 4U}) {
    for (const double weight : {0.0, 0.4, 1.0}) {
      HeightLog log(config().max_nodes);
      log.add({first, weight}, 4.0, 0.25);
      const double expected = residual(log.observations()[0], before_);
      log.thin(thinned_);
      ASSERT_EQ(log.observations().size(), 1U);
      const HeightObservation& seen = log.observations()[0];
      EXPECT_EQ(seen.span.first, first < kThinned ? first + 1 : first);
      EXPECT_NEAR(residual(seen, after_), expected, 1e-12) << first << " " << weight;
      EXPECT_EQ(seen.information, 4.0);
    }
  }
}

/// What lay on both sides of the node is one observation now, as sure as both, that says what they say in the
/// mean.
TEST_F(ThinnedHeightLogs, HaveOneObservationOfThoseOnBothSidesOfTheNode) {
  const double variances[] = {0.25, 0.5, 0.1, 1.0};
  for (std::uint32_t first = 0; first < 4; ++first)
    log_.add({first, 0.2 + 0.1 * first}, 2.0 + first, variances[first]);
  const std::vector<HeightObservation> seen_before = log_.observations();
  log_.thin(thinned_);
  ASSERT_EQ(log_.observations().size(), 3U);
  const HeightObservation& mean = log_.observations()[1];
  EXPECT_EQ(mean.span.first, kThinned);
  EXPECT_NEAR(mean.information, 2.0 + 10.0, 1e-12);
  EXPECT_NEAR(residual(mean, after_),
              (2.0 * residual(seen_before[1], before_) + 10.0 * residual(seen_before[2], before_)) / 12.0,
              1e-12);
  EXPECT_NEAR(residual(log_.observations()[0], after_), residual(seen_before[0], before_), 1e-12);
  EXPECT_NEAR(residual(log_.observations()[2], after_), residual(seen_before[3], before_), 1e-12);
}

/// So there is room for all that come, in a flight of any length.
TEST_F(HeightLogs, HaveNoMoreObservationsThanThereAreGapsBetweenNodes) {
  for (int i = 0; i < 3600; ++i) {
    const NodeSpan span = at(i);
    while (drift_.size() > config().max_nodes) {
      const auto node = drift_.next_to_thin();
      ASSERT_TRUE(node);
      log_.thin(*node);
      drift_.thin(*node);
    }
    log_.add(span, 3.0, 0.25);
    ASSERT_LE(log_.observations().size(), static_cast<std::size_t>(drift_.size() - 1));
    EXPECT_EQ(log_.observations().back().span.first, span.first);
    std::uint32_t least = drift_.begin();
    for (const HeightObservation& seen : log_.observations()) {
      ASSERT_GE(seen.span.first, least) << "one a gap, in order";
      least = seen.span.first + 1;
    }
    ASSERT_LT(least, drift_.end());
  }
  EXPECT_EQ(log_.observations().size(), static_cast<std::size_t>(drift_.size() - 1));
  EXPECT_EQ(log_.constant().information, 0.0);
}

}  // namespace
}  // namespace geoloc
