// SPDX-License-Identifier: Apache-2.0
// What reaches the estimator of the fields of view that cameras of a link tell.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::FrameFactory;

constexpr HostTime kCameraLinkStart{std::chrono::seconds{1'795'300'000}};
constexpr std::uint8_t kCameraType = 30, kNoAutopilotType = 8, kFirstCamera = 100, kSecondCamera = 101;
constexpr float kNotTold = std::numeric_limits<float>::quiet_NaN();

/// A vehicle whose clock is 0 at kCameraLinkStart, and which tells its attitude ten times a second.
class CameraLink : public ::testing::Test {
 protected:
  void SetUp() override { hear(vehicle_.heartbeat(), 1s); }

  void begin_anew() {
    link_ = VehicleLink(config_);
    sink_ = {};
    flown_ = 1s;
    hear(vehicle_.heartbeat(), 1s);
  }

  void hear(const Bytes& frame, Duration after_start) {
    link_.consume(kCameraLinkStart + after_start, frame.data(), frame.size(), sink_);
  }

  /// The vehicle alone, until then.
  void fly_until(Duration after_start) {
    for (; flown_ <= after_start; flown_ += 100ms) hear(vehicle_.attitude(VehicleTime{flown_}), flown_);
  }

  /// The message and the component that are asked for, at any time of half a minute.
  std::set<std::pair<int, int>> asked(FrameFactory& camera) {
    std::set<std::pair<int, int>> found;
    for (int i = 0; i < 300; ++i) {
      const Duration now = 1s + i * 100ms;
      fly_until(now);
      if (i % 10 == 0) hear(camera.heartbeat(kNoAutopilotType, kCameraType), now);
      link_.poll(kCameraLinkStart + now, [&](const std::uint8_t* frame, std::size_t) {
        constexpr std::uint8_t kCommandLong = 76, kHeader = 10, kTargetComponent = 31;
        if (frame[0] != 0xFD || frame[7] != kCommandLong) return;
        float message_id = 0.0F;
        std::memcpy(&message_id, frame + kHeader, sizeof message_id);
        found.emplace(static_cast<int>(message_id), frame[kHeader + kTargetComponent]);
      });
    }
    return found;
  }

  TelemetryCounts counts() const { return link_.status(kCameraLinkStart).telemetry; }

  MavlinkConfig config_;
  VehicleLink link_{config_};
  testing::CollectingSink sink_;
  FrameFactory vehicle_{{1, 1}}, camera_{{1, kFirstCamera}}, second_{{1, kSecondCamera}};
  Duration flown_ = 1s;
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
  EXPECT_TRUE(link_.status(kCameraLinkStart + 5s).has_zoom_changed);
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

TEST_F(CameraLink, AsksTheCameraItselfForItsFieldOfView) {
  EXPECT_EQ(asked(camera_).count({271, kFirstCamera}), 1U);
  config_.zoom_rate_hz = 0.0;
  begin_anew();
  EXPECT_EQ(asked(camera_).count({271, kFirstCamera}), 0U);
  config_ = {};
  config_.zoom_camera = kSecondCamera;
  begin_anew();
  EXPECT_EQ(asked(camera_).count({271, kFirstCamera}), 0U) << "another is wanted";
}

TEST_F(CameraLink, TellsOfACameraThatZoomsWithoutSayingWhatItSees) {
  fly_until(3s);
  hear(camera_.zoom_level(kNotTold), 3s);
  hear(camera_.zoom_level(20.0F), 3s);
  EXPECT_FALSE(link_.status(kCameraLinkStart + 3s).zooms_untold);
  hear(camera_.zoom_level(55.0F), 3s);
  EXPECT_TRUE(link_.status(kCameraLinkStart + 3s).zooms_untold);
  hear(camera_.field_of_view(VehicleTime{3s}, 60.0F, 40.0F), 3s);
  EXPECT_FALSE(link_.status(kCameraLinkStart + 3s).zooms_untold);
}

/// A replay of a flight with a camera must give what it gave before cameras were listened to, but for zooms.
TEST_F(CameraLink, TeachesNothingOfTheVehiclesClock) {
  VehicleLink without{config_};
  testing::CollectingSink sink;
  const auto both_hear = [&](const Bytes& frame, Duration now) {
    hear(frame, now);
    without.consume(kCameraLinkStart + now, frame.data(), frame.size(), sink);
  };
  both_hear(vehicle_.heartbeat(), 1s);
  for (int i = 0; i < 100; ++i) {
    const Duration now = 1s + i * 100ms;
    both_hear(vehicle_.attitude(VehicleTime{now - 30ms}), now);
    hear(camera_.field_of_view(VehicleTime{now}, 60.0F, 40.0F), now);
  }
  for (const Duration at : {2s, 7s})
    EXPECT_EQ(link_.clock().to_vehicle(kCameraLinkStart + at),
              without.clock().to_vehicle(kCameraLinkStart + at));
}

}  // namespace
}  // namespace geoloc::io
