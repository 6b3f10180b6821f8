// SPDX-License-Identifier: Apache-2.0
// A camera on a gimbal, which reports ten times a second how it holds the camera.
#include <geoloc/geoloc.hpp>

#include <cmath>
#include <cstdio>
#include <optional>

namespace {

using namespace std::chrono_literals;

constexpr geoloc::Geodetic kHome{47.3977, 8.5456};
constexpr double kSpeed_mps = 8.0, kHeight_m = 40.0;
const Eigen::Vector3d kObjectInEnu{5.0, 60.0, 0.0};  // east, north, up of where the flight begins

double seconds_of(geoloc::VehicleTime time) {
  return geoloc::seconds(time.time_since_epoch());
}

/// Northwards, a little nose-down, as multicopters fly.
geoloc::Rigid3d enu_from_body(geoloc::VehicleTime time, const geoloc::EulerAngles& angles) {
  return {geoloc::enu_from_ned() * geoloc::ned_from_body(angles),
          {0.0, kSpeed_mps * seconds_of(time), kHeight_m}};
}

/// The gimbal looks ahead, between 30 and 70 degrees down.
geoloc::EulerAngles gimbal_angles(geoloc::VehicleTime time) {
  return {0.0, (-50.0 + 20.0 * std::sin(seconds_of(time))) * geoloc::kRadPerDeg, 0.0};
}

/// What it reports: roll and pitch are against the horizon, yaw from the nose or from north, as it says.
geoloc::GimbalSample gimbal_sample(geoloc::VehicleTime time) {
  return {time, geoloc::ned_from_body(gimbal_angles(time)), geoloc::GimbalYaw::kFromNose};
}

}  // namespace

int main() {
  geoloc::GeolocatorConfig config;
  config.camera.intrinsics = geoloc::CameraIntrinsics::from_field_of_view(1920, 1080, 60.0);
  config.camera.mount = geoloc::CameraMount::on_gimbal();
  config.camera.mount.x_m = 0.15;  // where the camera is in the body
  config.camera.mount.z_m = 0.05;
  config.projector.min_depression_deg = 15.0;  // what is seen at a flatter angle is not used
  geoloc::Geolocator geolocator(config);
  const geoloc::CameraModel camera(config.camera.intrinsics);
  const geoloc::EulerAngles angles{0.0, -5.0 * geoloc::kRadPerDeg, 0.0};

  for (geoloc::VehicleTime now{0s}; now <= geoloc::VehicleTime{8s}; now += 20ms) {
    const auto since_start = now.time_since_epoch();
    if (since_start % 100ms == 0ms) {
      geolocator.add(geoloc::AttitudeSample{now, angles});
      geoloc::PositionSample position;
      position.time = now;
      position.position = geoloc::LocalFrame(kHome).to_geodetic({0.0, kSpeed_mps * seconds_of(now)});
      position.height_above_home_m = kHeight_m;
      geolocator.add(position);
      geolocator.add(gimbal_sample(now));
    }
    if (since_start % 100ms == 60ms) {
      geoloc::FrameDetections picture;
      picture.captured_at = now;
      const geoloc::Rigid3d gimbal_from_camera = geoloc::body_from_camera(config.camera.mount);
      const geoloc::Rigid3d enu_from_camera{
          geoloc::enu_from_ned() * geoloc::ned_from_body(gimbal_angles(now)) * gimbal_from_camera.rotation,
          enu_from_body(now, angles) * gimbal_from_camera.translation};
      const auto pixel = camera.pixel(enu_from_camera.inverse() * kObjectInEnu);
      if (pixel && camera.contains(*pixel, 30.0))
        picture.detections.push_back({{pixel->x() - 19.5, pixel->y() - 19.5, 40.0, 40.0}, 0.9, 0});
      geolocator.add(picture);
    }
    while (const auto frame = geolocator.process_next()) {
      if (!frame->is_located()) std::printf("%s\n", geoloc::explain(frame->fate));
    }
  }
  geolocator.finish();

  double off_m = 1e9;
  for (const geoloc::Track& object : geolocator.tracks()) {
    if (object.status != geoloc::TrackStatus::kConfirmed) continue;
    off_m = (object.position_in_enu.mean - kObjectInEnu.head<2>()).norm();
    std::printf("object %llu: %.2f m east, %.2f m north, %.2f m off, from %d looks\n",
                static_cast<unsigned long long>(object.id), object.position_in_enu.mean.x(),
                object.position_in_enu.mean.y(), off_m, object.hits);
  }
  return off_m < 0.1 ? 0 : 1;
}
