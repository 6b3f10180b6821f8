// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/stills/still.hpp"
#include "io/stills/tag_values.hpp"

namespace geoloc::io {
namespace {

constexpr double kMostAngle_deg = 360.0;

/// Names of three angles: roll, pitch, yaw.
using AngleNames = std::array<const char*, 3>;

/// A maker's tags of the camera's angles against north-east-down, and of the vehicle's.
struct Maker {
  AngleNames camera;
  AngleNames vehicle;
};

constexpr std::array<Maker, 4> kMakers{
    {{{"drone-dji:GimbalRollDegree", "drone-dji:GimbalPitchDegree", "drone-dji:GimbalYawDegree"},
      {"drone-dji:FlightRollDegree", "drone-dji:FlightPitchDegree", "drone-dji:FlightYawDegree"}},
     {{"drone:GimbalRollDegree", "drone:GimbalPitchDegree", "drone:GimbalYawDegree"},
      {"drone:FlightRollDegree", "drone:FlightPitchDegree", "drone:FlightYawDegree"}},
     {{"drone-parrot:CameraRollDegree", "drone-parrot:CameraPitchDegree", "drone-parrot:CameraYawDegree"},
      {"drone-parrot:DroneRollDegree", "drone-parrot:DronePitchDegree", "drone-parrot:DroneYawDegree"}},
     {{"drone-skydio:CameraOrientationNED/Roll", "drone-skydio:CameraOrientationNED/Pitch",
       "drone-skydio:CameraOrientationNED/Yaw"},
      {"drone-skydio:VehicleOrientationNED/Roll", "drone-skydio:VehicleOrientationNED/Pitch",
       "drone-skydio:VehicleOrientationNED/Yaw"}}}};

/// Pix4D's tags, which senseFly, Sentera and others write: 0, 0, 0 looks straight down, top to the north.
constexpr AngleNames kBodyNames{"Camera:Roll", "Camera:Pitch", "Camera:Yaw"};

std::optional<EulerAngles> angles_of(const PictureTags& tags, const AngleNames& names) {
  std::array<double, 3> angles_rad{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto angle_deg = number_of(tags.xmp_text(names[i]));
    if (!angle_deg || !(std::abs(*angle_deg) <= kMostAngle_deg)) return std::nullopt;
    angles_rad[i] = *angle_deg * kRadPerDeg;
  }
  return EulerAngles{angles_rad[0], angles_rad[1], wrap_to_pi(angles_rad[2])};
}

/// A vehicle whose attitude is not told is taken to be level below its camera's heading: only the camera's
/// own angles count.
std::optional<StillAttitude> by_camera(const PictureTags& tags, const Maker& maker) {
  const auto camera = angles_of(tags, maker.camera);
  if (!camera) return std::nullopt;
  const auto vehicle = angles_of(tags, maker.vehicle);
  StillAttitude attitude;
  attitude.source = AttitudeSource::kCamera;
  attitude.vehicle = vehicle.value_or(EulerAngles{0.0, 0.0, camera->yaw_rad});
  attitude.mount =
      CameraMount{}.turned_to(ned_from_body(attitude.vehicle).conjugate() * ned_from_body(*camera));
  if (vehicle) attitude.yaw_difference_deg = wrap_to_pi(camera->yaw_rad - vehicle->yaw_rad) * kDegPerRad;
  return attitude;
}

/// senseFly counts roll the other way (OpenDroneMap turns it back as well).
std::optional<EulerAngles> body_angles_of(const PictureTags& tags) {
  auto body = angles_of(tags, kBodyNames);
  if (body && tags.exif_text("Make").value_or("") == "senseFly") body->roll_rad = -body->roll_rad;
  return body;
}

std::optional<double> heading_rad_of(const PictureTags& tags) {
  const auto heading_deg = number_of(tags.exif_text("GPSImgDirection"));
  if (!heading_deg || !(std::abs(*heading_deg) <= kMostAngle_deg)) return std::nullopt;
  return wrap_to_pi(*heading_deg * kRadPerDeg);
}

}  // namespace

StillAttitude attitude_of(const PictureTags& tags) {
  for (const Maker& maker : kMakers) {
    if (const auto attitude = by_camera(tags, maker)) return *attitude;
  }
  StillAttitude attitude;
  if (const auto body = body_angles_of(tags)) {
    attitude.source = AttitudeSource::kBody;
    attitude.vehicle = *body;
  } else if (const auto heading_rad = heading_rad_of(tags)) {
    attitude.source = AttitudeSource::kHeading;
    attitude.vehicle.yaw_rad = *heading_rad;
  }
  return attitude;
}

}  // namespace geoloc::io
