// SPDX-License-Identifier: Apache-2.0
#include "calibration/height_log.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

class HeightLogs : public ::testing::Test {
 protected:
  NodeSpan at(double time_s) { return drift_.cover(VehicleTime{from_seconds(time_s)}, 0.5); }

  DriftTimeline drift_{DriftConfig{}};
  HeightLog log_{DriftConfig{}.max_nodes};
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
    while (drift_.size() > DriftConfig{}.max_nodes) {
      log_.freeze_oldest(drift_);
      drift_.freeze_oldest();
    }
  }
  EXPECT_NEAR(log_.constant().information, 25.0, 1e-9);
  EXPECT_NEAR(log_.constant().vector / log_.constant().information, 2.0, 1e-9);
  EXPECT_LE(log_.observations().size(), static_cast<std::size_t>(DriftConfig{}.max_nodes));
}

}  // namespace
}  // namespace geoloc
