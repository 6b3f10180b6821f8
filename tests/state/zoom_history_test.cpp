// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/zoom_history.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

VehicleTime at_s(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

Eigen::Vector2d focal(double fx_px) {
  return {fx_px, 0.9 * fx_px};
}

ZoomHistory told(std::initializer_list<std::pair<double, double>> samples) {
  ZoomHistory history;
  for (const auto& [time_s, fx_px] : samples) history.add(at_s(time_s), focal(fx_px));
  return history;
}

TEST(ZoomHistory, KnowsNothingOfACameraThatTellsNothing) {
  const ZoomHistory history;
  ASSERT_TRUE(history.at(at_s(1.0)));
  EXPECT_FALSE(history.at(at_s(1.0))->focal_px);
  EXPECT_FALSE(history.due_after(at_s(1.0)));
}

TEST(ZoomHistory, InterpolatesWhileTheCameraZooms) {
  const ZoomHistory history = told({{1.0, 1000.0}, {1.2, 1100.0}, {1.4, 1100.0}});
  const auto half_way = history.at(at_s(1.1));
  EXPECT_TRUE(half_way->focal_px->isApprox(focal(1050.0), 1e-12));
  EXPECT_GT(half_way->sigma_share, 0.01) << "0.05 s at a half a second are 2.5 %";
  EXPECT_LT(half_way->sigma_share, 0.05);
  EXPECT_EQ(*history.at(at_s(1.3))->focal_px, focal(1100.0));
  EXPECT_EQ(history.at(at_s(1.3))->sigma_share, 0.0);
}

TEST(ZoomHistory, HoldsTheFirstOneBeforeItAndTheLastOneAfterIt) {
  ZoomHistory history = told({{5.0, 1000.0}, {5.2, 2000.0}});
  EXPECT_EQ(*history.at(at_s(1.0))->focal_px, focal(1000.0));
  EXPECT_EQ(*history.at(at_s(99.0))->focal_px, focal(2000.0));
  history.restart();
  EXPECT_EQ(*history.at(at_s(0.5))->focal_px, focal(2000.0))
      << "the vehicle's clock began anew, not the zoom";
}

TEST(ZoomHistory, DoesNotGuessWhenAZoomChangedInALongGap) {
  const ZoomHistory changed = told({{1.0, 1000.0}, {6.0, 2000.0}});
  EXPECT_EQ(changed.at(at_s(3.0)).error(), NoState::kInAGap);
  const ZoomHistory same = told({{1.0, 1000.0}, {6.0, 1000.0}});
  EXPECT_EQ(*same.at(at_s(3.0))->focal_px, focal(1000.0));
}

TEST(ZoomHistory, WaitsForTheNextOneOfACameraThatTellsItRegularly) {
  const ZoomHistory regular = told({{1.0, 1000.0}, {1.2, 1000.0}, {1.4, 1000.0}});
  EXPECT_FALSE(regular.due_after(at_s(1.3)));
  ASSERT_TRUE(regular.due_after(at_s(1.5)));
  EXPECT_GT(*regular.due_after(at_s(1.5)), at_s(1.6));
  EXPECT_LT(*regular.due_after(at_s(1.5)), at_s(2.5));
  EXPECT_FALSE(told({{1.0, 1000.0}}).due_after(at_s(1.5))) << "one that tells changes alone";
  EXPECT_FALSE(told({{1.0, 1000.0}, {31.0, 1000.0}}).due_after(at_s(31.5)));
}

TEST(ZoomHistory, TakesSamplesInAnyOrder) {
  const ZoomHistory sorted = told({{1.0, 1000.0}, {1.2, 1100.0}, {1.4, 1200.0}});
  const ZoomHistory mixed = told({{1.0, 1000.0}, {1.4, 1200.0}, {1.2, 1100.0}});
  for (const double time_s : {0.5, 1.1, 1.2, 1.33, 2.0})
    EXPECT_EQ(*sorted.at(at_s(time_s))->focal_px, *mixed.at(at_s(time_s))->focal_px);
}

}  // namespace
}  // namespace geoloc
