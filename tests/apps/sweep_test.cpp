// SPDX-License-Identifier: Apache-2.0
#include "eval/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "eval/sweep_report.hpp"
#include "eval/sweep_run.hpp"

namespace geoloc::apps {
namespace {

RunResult run_of(Method method, int found, double rmse_m, int extra) {
  RunResult run;
  run.flight = "stock_path1";
  run.contender = {method, 0};
  run.score.targets = 30;
  run.score.found = found;
  if (found > 0) run.score.rmse_m = rmse_m;
  run.score.extra = extra;
  return run;
}

TEST(Sweep, EachHasItsOwnNameAndRisingValues) {
  std::vector<std::string> names;
  for (const Sweep& sweep : all_sweeps()) {
    names.push_back(sweep.name);
    EXPECT_TRUE(std::is_sorted(sweep.values.begin(), sweep.values.end())) << sweep.name;
    EXPECT_TRUE(sweep.flight_at || sweep.apply || sweep.targets_at) << sweep.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(find_sweeps("all").size(), names.size());
  EXPECT_EQ(find_sweeps("height").size(), 1U);
}

TEST(Sweep, UnknownNameIsRefusedWithThoseThereAre) {
  try {
    find_sweeps("depth");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("height"), std::string::npos);
  }
}

TEST(SweepReport, RunsThatFoundNothingHaveNoRmse) {
  const SweepPoint point{1.0,
                         {run_of(Method::kPaper, 0, 0.0, 2), run_of(Method::kJoint, 30, 0.2, 0),
                          run_of(Method::kPaper, 20, 0.6, 1), run_of(Method::kJoint, 30, 0.4, 0)},
                         0};
  const auto cells = cells_of(point);
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].contender.method, Method::kPaper);
  EXPECT_DOUBLE_EQ(cells[0].mean_rmse_m.value(), 0.6);
  EXPECT_EQ(cells[0].found, 20);
  EXPECT_EQ(cells[0].targets, 60);
  EXPECT_EQ(cells[0].extra, 3);
  EXPECT_DOUBLE_EQ(cells[1].mean_rmse_m.value(), 0.3);
  EXPECT_EQ(cells_of({1.0, {run_of(Method::kPaper, 0, 0.0, 2)}, 0})[0].mean_rmse_m, std::nullopt);
}

TEST(SweepReport, ChartNamesSharesNeverRoundedUpToAll) {
  SweepResult result{find_sweeps("latency").front(), {{0.0, {run_of(Method::kJoint, 30, 0.2, 4)}, 0}}};
  for (int i = 0; i < 99; ++i)
    result.points[0].runs.push_back(run_of(Method::kJoint, i == 0 ? 29 : 30, 0.2, 0));
  const Chart chart = chart_of(result);
  ASSERT_EQ(chart.rows.size(), 2U);
  EXPECT_EQ(chart.rows[0].cells[0].text, "99.9");
  EXPECT_EQ(chart.rows[1].cells[0].text, "4");
}

}  // namespace
}  // namespace geoloc::apps
