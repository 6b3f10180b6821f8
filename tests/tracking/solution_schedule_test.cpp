// SPDX-License-Identifier: Apache-2.0
#include "tracking/solution_schedule.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

VehicleTime schedule_time(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

TEST(SolutionSchedule, IsDueAfterEachOfTheFirstHundredFramesAndThenOnceAPeriod) {
  SolutionSchedule schedule(2.0);
  int due = 0;
  for (int frame = 1; frame <= 300; ++frame) {
    const VehicleTime now = schedule_time(0.1 * frame);
    schedule.count_frame();
    const bool is_due = schedule.is_due(now);
    ASSERT_EQ(is_due, frame <= 100 || frame % 20 == 0) << frame;
    if (!is_due) continue;
    schedule.begin_solution(now);
    ++due;
  }
  EXPECT_EQ(due, 110);
}

/// A hundred and one frames old, and just solved.
SolutionSchedule settled() {
  SolutionSchedule schedule(2.0);
  for (int frame = 0; frame < 101; ++frame) schedule.count_frame();
  schedule.begin_solution(schedule_time(50.0));
  return schedule;
}

TEST(SolutionSchedule, IsDueAfterEachOfSomeFramesOnceSomethingHasChanged) {
  SolutionSchedule schedule = settled();
  schedule.request_for_some_frames();
  int due = 0;
  VehicleTime now{from_seconds(1000.0)};
  schedule.begin_solution(now);
  for (int i = 0; i < 100; ++i) {
    now += from_seconds(0.001);
    schedule.count_frame();
    if (!schedule.is_due(now)) continue;
    schedule.begin_solution(now);
    ++due;
    EXPECT_EQ(due, i + 1);
  }
  EXPECT_EQ(due, 20);
}

TEST(SolutionSchedule, IsDueOnRequestOnce) {
  SolutionSchedule schedule = settled();
  EXPECT_FALSE(schedule.is_due(schedule_time(50.1)));
  schedule.request();
  EXPECT_TRUE(schedule.is_due(schedule_time(50.1)));
  schedule.begin_solution(schedule_time(50.1));
  EXPECT_FALSE(schedule.is_due(schedule_time(50.2)));
}

TEST(SolutionSchedule, IsDueWhenTheClockRanBack) {
  EXPECT_TRUE(settled().is_due(schedule_time(49.9)));
}

TEST(SolutionSchedule, IsDueWhereNothingWasEverSolved) {
  SolutionSchedule schedule(2.0);
  for (int frame = 0; frame < 200; ++frame) schedule.count_frame();
  EXPECT_TRUE(schedule.is_due(schedule_time(0.0)));
}

TEST(SolutionSchedule, TeachesTheWanderingWithEachSolutionAtFirstAndWithEachFifthLater) {
  SolutionSchedule schedule(2.0);
  for (std::uint64_t solution = 1; solution <= 200; ++solution) {
    schedule.begin_solution(schedule_time(0.1 * static_cast<double>(solution)));
    ASSERT_EQ(schedule.teaches_wandering(), solution <= 150 || solution % 5 == 0) << solution;
  }
}

}  // namespace
}  // namespace geoloc
