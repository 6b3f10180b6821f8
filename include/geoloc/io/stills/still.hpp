// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/stills/picture_tags.hpp"

namespace geoloc::io {

/// When a picture was taken, as its camera's clock had it.
struct CaptureTime {
  Duration local{};                    ///< since 1970, where the clock shows local time
  std::optional<Duration> utc_offset;  ///< what the clock is ahead of UTC, where the picture tells it
  bool has_fraction = false;           ///< of a second; without, it was taken at some time within that second
};

/// nullopt where no date can be read.
std::optional<CaptureTime> capture_time_of(const PictureTags& tags);

enum class FocalSource {
  kCalibration,  ///< the maker's calibration of this very lens
  kSensor,       ///< the focal length in mm, and the sensor's pixels per mm
  k35mm          ///< the equivalent for film of 35 mm, which is rounded: some 3 %
};

struct Lens {
  CameraIntrinsics intrinsics;
  FocalSource source = FocalSource::k35mm;
};

/// 1-sigma of a focal length from there [%].
double sigma_focal_percent(FocalSource source);

/// nullopt where no focal length is told.
std::optional<Lens> lens_of(const PictureTags& tags);

enum class AttitudeSource {
  kCamera,   ///< the camera's own angles, of its gimbal
  kBody,     ///< angles of a body that has its camera fixed below it
  kHeading,  ///< a heading alone: the camera is taken to look straight down
  kNone      ///< nothing: straight down, the heading unknown
};

/// How the camera looked: the vehicle's attitude and the camera in the vehicle.
struct StillAttitude {
  AttitudeSource source = AttitudeSource::kNone;
  EulerAngles vehicle;
  CameraMount mount;
  /// The camera's heading less the vehicle's, in [-180, 180], where both are told.
  std::optional<double> yaw_difference_deg;
};

StillAttitude attitude_of(const PictureTags& tags);

enum class HeightDatum { kMeanSeaLevel, kEllipsoid };

/// What a picture tells of itself, in the library's units.
struct Still {
  std::optional<CaptureTime> taken;
  Geodetic position;
  std::optional<double> height_above_take_off_m;
  std::optional<double> height_absolute_m;
  HeightDatum datum = HeightDatum::kMeanSeaLevel;  ///< of height_absolute_m
  std::optional<double> sigma_horizontal_m;        ///< 1-sigma, radial, as the receiver claims
  std::optional<double> sigma_height_m;            ///< the same
  std::optional<int> rtk_flag;                     ///< DJI's: 50 fixed, 34 float, 16 single, 0 none
  StillAttitude attitude;
  std::optional<Lens> lens;
  int width_px = 0;
  int height_px = 0;
};

/// Throws std::runtime_error naming what makes a picture useless, without a file's name: no position, no fix,
/// or a turned picture.
Still still_of(const PictureTags& tags);

}  // namespace geoloc::io
