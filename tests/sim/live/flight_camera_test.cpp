// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/flight_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/sim/flight/scenario.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

constexpr HostTime kReleased{std::chrono::seconds{1'800'000'000}};

VehicleTime at(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

class AtSpeed : public ::testing::TestWithParam<double> {
 protected:
  AtSpeed() : flight_(load("stock_path1")), clock_({at(100.0), at(160.0)}, GetParam()) {
    settings_.camera.intrinsics = CameraIntrinsics::from_field_of_view(160, 90, 70.0);
    clock_.release(kReleased);
  }

  Flight flight_;
  FlightClock clock_;
  RunSettings settings_;
};

TEST_P(AtSpeed, PicturesAreOlderThanTheirStampsByTheSameFlownTime) {
  FlightCamera camera(flight_, settings_, clock_, {});
  double sum_s = 0.0, squares_s2 = 0.0;
  constexpr int kViews = 4000;
  for (int i = 0; i < kViews; ++i) {
    const HostTime stamp = kReleased + from_seconds(1.0 + 0.001 * i);
    const double flown_s = GetParam() * seconds(stamp - camera.draw_view(stamp).exposed_at);
    sum_s += flown_s;
    squares_s2 += flown_s * flown_s;
  }
  const double mean_s = sum_s / kViews;
  EXPECT_NEAR(mean_s, 0.12, 0.001);
  EXPECT_NEAR(std::sqrt(squares_s2 / kViews - mean_s * mean_s), 0.01, 0.0005);
}

TEST_P(AtSpeed, PoseIsTheTrueOneWithTheTrueMount) {
  settings_.errors.mount_error_deg = {1.0, -2.0, 3.0};
  FlightCamera camera(flight_, settings_, clock_, {});
  const FlightCamera::View view = camera.draw_view(kReleased + std::chrono::seconds{5});
  const double flown_s = GetParam() * seconds(view.exposed_at - kReleased);
  const Rigid3d expected =
      flight_.truth.pose(at(100.0 + flown_s)).value() * make_true_camera(settings_, 0).carrier_from_camera;
  EXPECT_LT((view.enu_from_camera.translation - expected.translation).norm(), 1e-6);
  EXPECT_LT(view.enu_from_camera.rotation.angularDistance(expected.rotation), 1e-6);
}

TEST_P(AtSpeed, BlurIsThatOfTheFlightAsItWasFlown) {
  FlightClock recorded_clock(clock_.span(), 1.0);
  recorded_clock.release(kReleased);
  settings_.errors.latency_s = settings_.errors.latency_jitter_s = 0.0;
  FlightCamera fast(flight_, settings_, clock_, {}), slow(flight_, settings_, recorded_clock, {});
  const Eigen::Vector2d blur = fast.draw_view(kReleased + from_seconds(8.0 / GetParam())).blur_px;
  const Eigen::Vector2d expected = slow.draw_view(kReleased + from_seconds(8.0)).blur_px;
  EXPECT_NEAR((blur - expected).norm(), 0.0, 1e-3);
  EXPECT_GT(expected.norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Speeds, AtSpeed, ::testing::Values(1.0, 4.0));

TEST(RunScene, HoldsEveryTargetAndSetsTheGroundBySeed) {
  const auto targets_in_enu = make_scenario(2, 5);
  const Scene scene = make_run_scene(targets_in_enu, 10, 5);
  std::vector<Eigen::Vector2d> fiducials_in_enu;
  for (const PlacedObject& object : scene.objects) {
    if (object.kind == ObjectKind::kFiducial) fiducials_in_enu.push_back(object.position_in_enu);
  }
  EXPECT_EQ(fiducials_in_enu, targets_in_enu);
  EXPECT_GT(scene.objects.size(), targets_in_enu.size());
  EXPECT_EQ(make_run_scene(targets_in_enu, 10, 5).ground, scene.ground);
}

}  // namespace
}  // namespace geoloc::sim
