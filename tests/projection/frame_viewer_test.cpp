// SPDX-License-Identifier: Apache-2.0
#include "projection/frame_viewer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::at_s;
using testing::geodetic_of;

constexpr double kRoll_rad = 10.0 * kRadPerDeg;

/// A vehicle that flies to the north-east and climbs, its nose to the east and its right wing down. Between
/// its reports it is on a straight line, so that its position is known at every moment.
class FrameViews : public ::testing::Test {
 protected:
  /// Ten reports a second, until then.
  void fly_until(double time_s) {
    for (; 0.1 * samples_ <= time_s + 1e-9; ++samples_) report(0.1 * samples_);
  }

  void report(double time_s) {
    const Eigen::Vector3d place = place_at(time_s);
    PositionSample position;
    position.time = at_s(time_s);
    position.position = geodetic_of(place.head<2>());
    position.height_above_home_m = place.z();
    position.height_msl_m = place.z() + 10.0;
    position.sigma_horizontal_m = 0.7;
    state_.add(position);
    state_.add(AttitudeSample{at_s(time_s), {kRoll_rad, 0.0, 90.0 * kRadPerDeg}});
  }

  static Eigen::Vector3d place_at(double time_s) { return {3.0 * time_s, 4.0 * time_s, 20.0 + 0.5 * time_s}; }

  Expected<FrameView, NoState> view(double time_s, double latency_s,
                                    CameraOrientation orientation = CameraOrientation::kComposed) const {
    const FrameViewer viewer{state_, mount_, orientation};
    return viewer.nominal_view({at_s(time_s), host_time_}, latency_s);
  }

  StateProvider state_{StateConfig{}};
  CameraMount mount_;
  HostTime host_time_{from_seconds(1e9)};
  int samples_ = 0;
};

TEST_F(FrameViews, AreFromWhereTheVehicleIsOnceItsPositionsLagIsKnown) {
  fly_until(10.0);
  Calibration calibration;
  calibration.mean[CalibrationIndex::kPositionLag] = 0.1;
  const FrameView corrected = calibrated(*view(6.0, 0.0), calibration, 2.0);
  const Eigen::Vector3d lifted = place_at(6.1) + Eigen::Vector3d(0.0, 0.0, 2.0);
  EXPECT_LT((corrected.enu_from_camera.translation - lifted).norm(), 1e-3);
}

TEST_F(FrameViews, AreFromWhereTheVehicleWasByTheLatencyBeforeTheStamp) {
  fly_until(10.0);
  for (const double latency_s : {0.0, 0.04, 0.25, 3.0, -0.5}) {  // a stamp may be too early, too
    const auto frame = view(6.0, latency_s);
    ASSERT_TRUE(frame) << latency_s;
    EXPECT_EQ(frame->vehicle.time, at_s(6.0 - latency_s));
    EXPECT_LT((frame->vehicle.enu_from_body.translation - place_at(6.0 - latency_s)).norm(), 1e-3);
    EXPECT_LT((frame->vehicle.velocity_in_enu - Eigen::Vector3d(3.0, 4.0, 0.5)).norm(), 1e-3);
    EXPECT_LT((frame->enu_from_camera.translation - place_at(6.0 - latency_s)).norm(), 1e-3);
    EXPECT_EQ(frame->latency_s, latency_s);
    EXPECT_EQ(frame->captured_at_host, host_time_);  // by the stamp, whatever the latency
    EXPECT_EQ(frame->lifted_m, 0.0);
    EXPECT_EQ(frame->vehicle.sigma_horizontal_m, 0.7);
  }
}

/// The camera looks straight down from the vehicle, half a metre before and a quarter beneath its middle.
TEST_F(FrameViews, AreFromTheCamerasPlaceInTheVehicle) {
  mount_.x_m = 0.5;
  mount_.z_m = 0.25;
  fly_until(2.0);
  const auto frame = view(1.5, 0.1);
  ASSERT_TRUE(frame);
  // With the nose to the east, the right wing is to the south, and down: the belly looks north.
  const Eigen::Vector3d nose(1.0, 0.0, 0.0), belly(0.0, std::sin(kRoll_rad), -std::cos(kRoll_rad));
  const Rigid3d& camera = frame->enu_from_camera;
  EXPECT_LT((camera.translation - place_at(1.4) - 0.5 * nose - 0.25 * belly).norm(), 1e-3);
  EXPECT_LT((camera.rotation * Eigen::Vector3d::UnitZ() - belly).norm(), 1e-5);
  EXPECT_LT((camera.rotation * -Eigen::Vector3d::UnitY() - nose).norm(), 1e-5);
}

/// Where the mount's angles are added to the vehicle's, a camera that looks down does not follow its roll.
TEST_F(FrameViews, AreOfTheOrientationAskedFor) {
  fly_until(2.0);
  const auto tilt_rad = [&](CameraOrientation orientation) {
    const Eigen::Vector3d axis =
        view(1.5, 0.1, orientation)->enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
    return std::atan2(axis.head<2>().norm(), -axis.z());
  };
  EXPECT_NEAR(tilt_rad(CameraOrientation::kComposed), kRoll_rad, 1e-6);
  EXPECT_NEAR(tilt_rad(CameraOrientation::kAddedAngles), 0.0, 1e-6);
}

TEST_F(FrameViews, ThatAreNoneSayWhy) {
  EXPECT_EQ(view(1.0, 0.1).error(), NoState::kNoSamples);
  fly_until(2.0);
  EXPECT_EQ(view(2.5, 0.1).error(), NoState::kNotYet);
  EXPECT_EQ(view(0.5, 0.6).error(), NoState::kTooOld);
  samples_ += 40;
  fly_until(7.0);
  EXPECT_EQ(view(2.5, 0.1).error(), NoState::kInAGap);
  state_.restart();
  EXPECT_EQ(view(2.5, 0.1).error(), NoState::kNoSamples);
}

/// A frame of which there is no view by the one latency may have one by another.
TEST_F(FrameViews, AreLookedUpAnewWithEveryLatency) {
  fly_until(2.0);
  EXPECT_FALSE(view(2.2, 0.1));
  EXPECT_TRUE(view(2.2, 0.3));
  EXPECT_TRUE(view(0.2, 0.1));
  EXPECT_FALSE(view(0.2, 0.3));
}

/// A viewer refers to the state: what has come since counts.
TEST_F(FrameViews, FollowWhatTheVehicleReportsSince) {
  const FrameViewer viewer{state_, mount_, CameraOrientation::kComposed};
  const FrameStamp stamp{at_s(3.0), host_time_};
  fly_until(2.0);
  EXPECT_FALSE(viewer.nominal_view(stamp, 0.1));
  fly_until(3.0);
  ASSERT_TRUE(viewer.nominal_view(stamp, 0.1));
  EXPECT_LT((viewer.nominal_view(stamp, 0.1)->enu_from_camera.translation - place_at(2.9)).norm(), 1e-3);
}

/// The ground 7 m above the level one comes to lie in the projector's plane: the camera stands 13 m above
/// that ground, and 2 m more by the calibration.
TEST_F(FrameViews, StandAboveTheGroundBelowTheVehicle) {
  FrameView nominal;
  nominal.enu_from_camera.translation = {3.0, 4.0, 20.0};
  nominal.terrain_m = 7.0;
  const FrameView view = calibrated(nominal, Calibration{}, 2.0);
  EXPECT_EQ(view.enu_from_camera.translation, Eigen::Vector3d(3.0, 4.0, 15.0));
  EXPECT_EQ(view.lifted_m, -5.0);
  EXPECT_EQ(view.terrain_m, 7.0);
}

}  // namespace
}  // namespace geoloc
