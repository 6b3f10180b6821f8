// SPDX-License-Identifier: Apache-2.0
// What reaches the estimator of the fields of view that cameras of a link tell.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/component_link.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::FrameFactory;

constexpr std::uint8_t kCameraType = 30, kNoAutopilotType = 8, kFirstCamera = 100, kSecondCamera = 101;
constexpr float kNotTold = std::numeric_limits<float>::quiet_NaN();

class CameraLink : public testing::ComponentLink {
 protected:
  /// What is asked for while the camera tells that it is there.
  std::set<std::pair<int, int>> asked_of(FrameFactory& camera) {
    return asked([&](Duration now) {
      if (now % 1s == 0s) hear(camera.heartbeat(kNoAutopilotType, kCameraType), now);
    });
  }

  FrameFactory camera_{{1, kFirstCamera}}, second_{{1, kSecondCamera}};
};

/// A camera counts from its own boot, which says nothing of the vehicle's clock.
TEST_F(CameraLink, TimesACameraByWhenItsMessagesCome) {
  for (int i = 0; i < 50; ++i) {
    const Duration now = 1s + i * 200ms;
    fly_until(now);
    const Duration jitter = i % 5 == 0 ? 0ms : 40ms;  // the link delays most of them
    hear(camera_.field_of_view(VehicleTime{now + 777s}, 60.0F, 40.0F), now + jitter);
  }
  ASSERT_EQ(sink_.fields_of_view.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(sink_.fields_of_view[i].time, VehicleTime{1s + i * 200ms}) << i;
  EXPECT_NEAR(*sink_.fields_of_view[0].horizontal_rad, 60.0 * kRadPerDeg, 1e-6);
  EXPECT_NEAR(*sink_.fields_of_view[0].vertical_rad, 40.0 * kRadPerDeg, 1e-6);
}

TEST_F(CameraLink, TakesAnglesThatAreNotToldForNone) {
  fly_until(3s);
  for (const float none : {kNotTold, 0.0F, -5.0F, 180.0F, std::numeric_limits<float>::infinity()}) {
    begin_anew();
    fly_until(3s);
    hear(camera_.field_of_view(VehicleTime{3s}, none, none), 3s);
    EXPECT_TRUE(sink_.fields_of_view.empty()) << none;
    hear(camera_.field_of_view(VehicleTime{3s}, none, 40.0F), 3s);
    ASSERT_EQ(sink_.fields_of_view.size(), 1U) << none;
    EXPECT_FALSE(sink_.fields_of_view[0].horizontal_rad);
  }
}

TEST_F(CameraLink, TakesAStampOfZeroForNone) {
  fly_until(3s);
  hear(camera_.field_of_view(VehicleTime{}, 60.0F, 40.0F), 3s);
  ASSERT_EQ(sink_.fields_of_view.size(), 1U);
  EXPECT_EQ(sink_.fields_of_view[0].time, VehicleTime{3s});
}

TEST_F(CameraLink, ListensToOneCamera) {
  FrameFactory gimbal({1, 154}), other_vehicle({2, kFirstCamera});
  for (const int wanted : {0, static_cast<int>(kSecondCamera), 2}) {
    config_.zoom_camera = wanted;
    begin_anew();
    for (int i = 0; i < 20; ++i) {
      const Duration now = 1s + i * 200ms;
      fly_until(now);
      hear(gimbal.field_of_view(VehicleTime{now}, 10.0F, 5.0F), now);
      hear(other_vehicle.field_of_view(VehicleTime{now}, 20.0F, 10.0F), now);
      hear(camera_.field_of_view(VehicleTime{now}, 30.0F, 15.0F), now);
      hear(second_.field_of_view(VehicleTime{now}, 40.0F, 20.0F), now);
      hear(vehicle_.field_of_view(VehicleTime{now}, 50.0F + static_cast<float>(i), 25.0F, 2), now);
    }
    const double expected_deg = wanted == 0 ? 30.0 : wanted == 2 ? 69.0 : 40.0;
    ASSERT_EQ(sink_.fields_of_view.size(), wanted == 2 ? 19U : 20U) << wanted;
    EXPECT_NEAR(*sink_.fields_of_view.back().horizontal_rad, expected_deg * kRadPerDeg, 1e-6);
  }
}

/// It mostly tells a parameter, which may be wrong, and the calibration is better.
TEST_F(CameraLink, TakesWhatTheAutopilotSaysOfACameraOnceItChanges) {
  for (int i = 0; i < 20; ++i) {
    const Duration now = 1s + i * 200ms;
    fly_until(now);
    hear(vehicle_.field_of_view(VehicleTime{now}, i < 10 ? 62.0F : 31.0F, kNotTold), now);
  }
  ASSERT_EQ(sink_.fields_of_view.size(), 10U);
  EXPECT_EQ(sink_.fields_of_view[0].time, VehicleTime{3s});
  EXPECT_TRUE(status(5s).has_zoom_changed);
}

TEST_F(CameraLink, PrefersACameraToTheAutopilot) {
  for (int i = 0; i < 20; ++i) {
    const Duration now = 1s + i * 200ms;
    fly_until(now);
    hear(vehicle_.field_of_view(VehicleTime{now}, 62.0F + static_cast<float>(i), kNotTold), now);
    if (i >= 10) hear(camera_.field_of_view(VehicleTime{now}, 30.0F, kNotTold), now);
  }
  EXPECT_NEAR(*sink_.fields_of_view.back().horizontal_rad, 30.0 * kRadPerDeg, 1e-6);
  EXPECT_EQ(counts().other_cameras, 9U);
}

TEST_F(CameraLink, HearsNoEchoOfTheCameraThatGeolocIs) {
  config_.camera = true;
  begin_anew();
  FrameFactory self({1, static_cast<std::uint8_t>(config_.camera_component_id)});
  fly_until(3s);
  hear(self.field_of_view(VehicleTime{3s}, 60.0F, 40.0F), 3s);
  EXPECT_TRUE(sink_.fields_of_view.empty());
}

/// Before it is known to be more than a parameter, too.
TEST_F(CameraLink, TellsTheWidestThatWasHeardWhetherItIsUsedOrNot) {
  const auto widest_deg = [&](Duration now) {
    const auto view = status(now).widest_view;
    return view ? *view->horizontal_rad * kDegPerRad : 0.0;
  };
  fly_until(3s);
  EXPECT_EQ(widest_deg(3s), 0.0);
  hear(vehicle_.field_of_view(VehicleTime{3s}, 62.0F, kNotTold), 3s);
  EXPECT_TRUE(sink_.fields_of_view.empty());
  EXPECT_NEAR(widest_deg(3s), 62.0, 1e-4);
  hear(vehicle_.field_of_view(VehicleTime{3s + 200ms}, 31.0F, kNotTold), 3s + 200ms);
  EXPECT_NEAR(widest_deg(4s), 62.0, 1e-4);
  hear(camera_.field_of_view(VehicleTime{3s + 400ms}, 50.0F, kNotTold), 3s + 400ms);  // goes before it
  EXPECT_NEAR(widest_deg(4s), 50.0, 1e-4);
  begin_anew();
  EXPECT_EQ(widest_deg(4s), 0.0);
}

TEST_F(CameraLink, AsksTheCameraItselfForItsFieldOfView) {
  EXPECT_EQ(asked_of(camera_).count({271, kFirstCamera}), 1U);
  config_.zoom_rate_hz = 0.0;
  begin_anew();
  EXPECT_EQ(asked_of(camera_).count({271, kFirstCamera}), 0U);
  config_ = {};
  config_.zoom_camera = kSecondCamera;
  begin_anew();
  EXPECT_EQ(asked_of(camera_).count({271, kFirstCamera}), 0U) << "another is wanted";
}

TEST_F(CameraLink, TellsOfACameraThatZoomsWithoutSayingWhatItSees) {
  fly_until(3s);
  hear(camera_.zoom_level(kNotTold), 3s);
  hear(camera_.zoom_level(20.0F), 3s);
  EXPECT_FALSE(status(3s).zooms_untold);
  hear(camera_.zoom_level(55.0F), 3s);
  EXPECT_TRUE(status(3s).zooms_untold);
  hear(camera_.field_of_view(VehicleTime{3s}, 60.0F, 40.0F), 3s);
  EXPECT_FALSE(status(3s).zooms_untold);
}

TEST_F(CameraLink, TeachesNothingOfTheVehiclesClock) {
  expect_clock_untaught([&](VehicleTime now) { return camera_.field_of_view(now, 60.0F, 40.0F); });
}

}  // namespace
}  // namespace geoloc::io
