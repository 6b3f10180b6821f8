// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/boot_clock_monitor.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

using Verdict = BootClockMonitor::Verdict;
VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}

TEST(BootClockMonitor, LetsLatePacketsThrough) {
  BootClockMonitor monitor;
  for (const double s : {10.0, 10.1, 9.9, 10.2, 6.0, 10.3})
    EXPECT_EQ(monitor.observe(at_s(s)), Verdict::kAdvanced);
}

TEST(BootClockMonitor, BelievesARebootAfterThreeStampsThatAgree) {
  BootClockMonitor monitor;
  EXPECT_EQ(monitor.observe(at_s(279.0)), Verdict::kAdvanced);
  EXPECT_EQ(monitor.observe(at_s(19.0)), Verdict::kSuspect);
  EXPECT_EQ(monitor.observe(at_s(19.1)), Verdict::kSuspect);
  EXPECT_EQ(monitor.observe(at_s(19.2)), Verdict::kRebooted);
  EXPECT_EQ(monitor.observe(at_s(19.3)), Verdict::kAdvanced);
}

TEST(BootClockMonitor, IsNotTurnedByStrayStamps) {
  BootClockMonitor monitor;
  monitor.observe(at_s(100.0));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(monitor.observe(at_s(i % 2 == 0 ? 3.0 : 50.0)), Verdict::kSuspect);
    EXPECT_EQ(monitor.observe(at_s(100.1 + i)), Verdict::kAdvanced);
  }
}

TEST(BootClockMonitor, RecoversFromAStampFarAhead) {
  BootClockMonitor monitor;
  monitor.observe(at_s(100.0));
  EXPECT_EQ(monitor.observe(at_s(4e6)), Verdict::kSuspect);
  EXPECT_EQ(monitor.observe(at_s(100.1)), Verdict::kAdvanced);
}

TEST(BootClockMonitor, BelievesAPauseOfTheLinkAfterThreeStampsThatAgree) {
  BootClockMonitor monitor;
  monitor.observe(at_s(100.0));
  EXPECT_EQ(monitor.observe(at_s(160.0)), Verdict::kSuspect);
  EXPECT_EQ(monitor.observe(at_s(160.1)), Verdict::kSuspect);
  EXPECT_EQ(monitor.observe(at_s(160.2)), Verdict::kAdvanced) << "not a reboot";
  EXPECT_EQ(monitor.observe(at_s(160.3)), Verdict::kAdvanced);
}

}  // namespace
}  // namespace geoloc
