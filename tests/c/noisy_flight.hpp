// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <random>

#include "both.hpp"

namespace geoloc {

/// A minute to and fro over objects on a square, some of which move, with noise in all that is measured.
class NoisyFlight {
 public:
  explicit NoisyFlight(const CameraConfig& camera) : mount_(camera.mount), model_(camera.intrinsics) {}

  void fly(Both& both) {
    using namespace std::chrono_literals;
    for (VehicleTime now{0s}; now <= VehicleTime{60s}; now += 50ms) {
      const auto since_start = now.time_since_epoch();
      if (since_start % 100ms == 0ms) add_telemetry(now, both);
      if (since_start % 200ms == 150ms) both.add(picture(now));
      both.process();
    }
    both.finish();
  }

 private:
  double noise(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

  static EulerAngles angles(double t) {
    return {0.05 * std::sin(t), -0.04 + 0.03 * std::cos(1.3 * t), std::sin(0.3 * t)};
  }
  static Eigen::Vector3d place(double t) {
    return {15.0 * std::sin(0.2 * t), 12.0 * std::sin(0.13 * t), 25.0};
  }
  static EulerAngles gimbal(double t) {
    return {0.0, -1.4 + 0.1 * std::sin(0.7 * t), 0.2 * std::sin(0.4 * t)};
  }

  void add_telemetry(VehicleTime now, Both& both) {
    const double t = seconds(now.time_since_epoch());
    EulerAngles told = angles(t);
    told.roll_rad += noise(2e-3);
    both.add(AttitudeSample{
        now, told, Eigen::Vector3d(0.05 * std::cos(t), -0.039 * std::sin(1.3 * t), 0.3 * std::cos(0.3 * t))});
    PositionSample position;
    position.time = now;
    position.position =
        LocalFrame({47.4, 8.5}).to_geodetic(place(t).head<2>() + Eigen::Vector2d(noise(0.1), noise(0.1)));
    position.height_above_home_m = place(t).z() + noise(0.05);
    position.height_msl_m = 425.0 + place(t).z();
    position.sigma_horizontal_m = 0.6;
    position.velocity_in_enu = Eigen::Vector3d(3.0 * std::cos(0.2 * t), 1.56 * std::cos(0.13 * t), 0.0);
    both.add(position);
    both.add(RangeSample{now, place(t).z() + noise(0.02)});
    if (mount_.kind == MountKind::kGimbal) {
      both.add(GimbalSample{now, ned_from_body(gimbal(t)), GimbalYaw::kFromNose, false});
      both.add(FieldOfViewSample{now, 1.2 + noise(1e-4), std::nullopt});
    }
  }

  Rigid3d enu_from_camera(double t) const {
    const Rigid3d enu_from_body{enu_from_ned() * ned_from_body(angles(t)), place(t)};
    if (mount_.kind == MountKind::kFixed) return enu_from_body * body_from_camera(mount_);
    const EulerAngles yaw{0.0, 0.0, angles(t).yaw_rad};
    return {
        enu_from_ned() * ned_from_body(yaw) * ned_from_body(gimbal(t)) * body_from_camera(mount_).rotation,
        place(t)};
  }

  FrameDetections picture(VehicleTime now) {
    const double t = seconds(now.time_since_epoch());
    using namespace std::chrono_literals;
    FrameDetections frame;
    frame.captured_at = now;
    frame.captured_at_host = HostTime{now.time_since_epoch() + 1'700'000'000s};
    frame.time_sigma_s = 0.004;
    for (int i = 0; i < 16; ++i) {
      const int class_id = i % 4;
      const int column = i % 4, row = i / 4;
      Eigen::Vector3d object(-12.0 + 8.0 * column, -12.0 + 8.0 * row, 0.1 * i);
      if (class_id == 3) object.x() += 0.4 * t;
      const auto pixel = model_.pixel(enu_from_camera(t).inverse() * object);
      if (!pixel || !model_.contains(*pixel, 20.0) || noise(1.0) > 1.6) continue;
      frame.detections.push_back(
          {{pixel->x() - 14.5 + noise(0.7), pixel->y() - 14.5 + noise(0.7), 30.0, 30.0}, 0.8, class_id, 0.7});
    }
    return frame;
  }

  CameraMount mount_;
  CameraModel model_;
  std::mt19937_64 random_{7};
};

}  // namespace geoloc
