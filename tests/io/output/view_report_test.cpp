// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc::io {
namespace {

using Eigen::Vector3d;

/// Heading, then pitch, then roll, of axes forward, right, down: from those axes to north, east, down.
Eigen::Matrix3d turned(double heading_deg, double pitch_deg, double roll_deg) {
  return (Eigen::AngleAxisd(heading_deg * kRadPerDeg, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_deg * kRadPerDeg, Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_deg * kRadPerDeg, Vector3d::UnitX()))
      .toRotationMatrix();
}

ViewReport view_of(const GeolocatorConfig& config, const testing::Pose& pose) {
  testing::NadirFlight flight(config, [pose](double) { return pose; });
  const bool is_located = flight.see(1.0, {{pose.position.x(), pose.position.y()}});
  const OutputFrame frame =
      FrameReporter({}).report(flight.geolocator(), is_located, testing::host_at_s(1.0), {});
  return frame.view.value();
}

GeolocatorConfig camera_mounted(double roll_deg, double pitch_deg, double yaw_deg) {
  GeolocatorConfig config = testing::noisy_by_the_detector_alone();
  config.camera.mount.roll_deg = roll_deg;
  config.camera.mount.pitch_deg = pitch_deg;
  config.camera.mount.yaw_deg = yaw_deg;
  return config;
}

/// The vehicle's angles and the camera's against it make up where the camera looks, as readers of metadata
/// take them.
TEST(ViewReport, TellsTheCamerasAnglesAgainstTheVehicle) {
  const struct {
    double roll, pitch, yaw;
  } mounts[] = {{0, -90, 0}, {0, -60, 0}, {3, -45, 30}, {-5, -30, 160}, {2, -75, -90}};
  for (const auto& mount : mounts) {
    const ViewReport view =
        view_of(camera_mounted(mount.roll, mount.pitch, mount.yaw), {{0.0, 0.0, 20.0}, 0.12, -0.2, 2.1});
    const Eigen::Matrix3d ned_from_vehicle = turned(view.yaw_deg, view.pitch_deg, view.roll_deg);
    const Eigen::Matrix3d vehicle_from_camera =
        turned(view.camera_in_vehicle.azimuth_deg, view.camera_in_vehicle.elevation_deg,
               view.camera_in_vehicle.roll_deg);
    const Eigen::Matrix3d ned_from_camera = ned_from_vehicle * vehicle_from_camera;
    const Eigen::Matrix3d told =
        turned(view.sight.azimuth_deg, view.sight.elevation_deg, view.sight.roll_deg);
    EXPECT_LT((ned_from_camera - told).norm(), 1e-6) << mount.pitch;
    EXPECT_NEAR(std::remainder(view.camera_in_vehicle.azimuth_deg - mount.yaw, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(view.camera_in_vehicle.elevation_deg, mount.pitch, 1e-5);
  }
}

TEST(ViewReport, TellsTheHeightsOfCameraAndGround) {
  GeolocatorConfig config = camera_mounted(0.0, -60.0, 0.0);
  config.camera.mount.z_m = 0.5;  // below the autopilot
  config.projector.ground_height_above_home_m = -3.0;
  const ViewReport view = view_of(config, {{0.0, 0.0, 20.0}, 0.0, 0.0, 0.0});
  EXPECT_NEAR(view.camera_height.above_home_m, 19.5, 1e-6);
  EXPECT_NEAR(view.camera_height.msl_m.value(), 29.5, 1e-6);  // home is 10 m above the sea
  EXPECT_NEAR(view.ground_height.above_home_m, -3.0, 1e-6);
  EXPECT_NEAR(view.ground_height.msl_m.value(), 7.0, 1e-6);
  EXPECT_NEAR(view.sight.range_m.value(), 22.5 / std::cos(30.0 * kRadPerDeg), 1e-3);
}

}  // namespace
}  // namespace geoloc::io
