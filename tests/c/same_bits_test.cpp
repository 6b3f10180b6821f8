// SPDX-License-Identifier: Apache-2.0
// A flight through C gives what it gives through C++, to the bit.
#include <gtest/gtest.h>

#include <cstddef>

#include "both.hpp"
#include "noisy_flight.hpp"

namespace geoloc {
namespace {

using namespace std::chrono_literals;

void expect_same_flight(const GeolocatorConfig& config, std::size_t least_objects) {
  Both both(config);
  NoisyFlight(config.camera).fly(both);
  EXPECT_GE(both.expect_same_objects(), least_objects);
  both.expect_same_calibration();
  both.expect_same_counters();
  both.expect_same_frame();
}

TEST(CGivesTheSameBitsAsCpp, ByTheJointMethod) {
  GeolocatorConfig config;
  config.joint.moving.classes = {3};
  config.camera.intrinsics.distortion = {-0.1, 0.02, 1e-3, -1e-3, 0.0};
  expect_same_flight(config, 12);
}

TEST(CGivesTheSameBitsAsCpp, ByThePapersMethod) {
  GeolocatorConfig config;
  config.method = Method::kPaper;
  expect_same_flight(config, 12);
}

TEST(CGivesTheSameBitsAsCpp, OnAGimbalThatZooms) {
  GeolocatorConfig config;
  config.camera.mount = CameraMount::on_gimbal();
  config.camera.mount.x_m = 0.1;
  expect_same_flight(config, 12);
}

TEST(CGivesTheSameBitsAsCpp, WhereFramesAreTooMany) {
  Both both(GeolocatorConfig{});
  for (int i = 0; i < 70; ++i) {
    FrameDetections frame;
    frame.captured_at = VehicleTime{i * 10ms};
    both.add(frame);
  }
  both.expect_same_counters();
}

}  // namespace
}  // namespace geoloc
