// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/uas_datalink.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "local_set.hpp"

namespace geoloc::io {
namespace {

constexpr std::string_view kKey{"\x06\x0e\x2b\x34\x02\x0b\x01\x01\x0e\x01\x03\x01\x01\x00\x00\x00", 16};
constexpr std::uint64_t kVersion = 17;  // of the standard: its last number

// Items by their tags.
constexpr std::uint8_t kTimeStamp = 2;
constexpr std::uint8_t kHeading = 5, kPitch = 6, kRoll = 7, kFullPitch = 90, kFullRoll = 91;
constexpr std::uint8_t kSensorLatitude = 13, kSensorLongitude = 14, kSensorMsl = 15, kSensorEllipsoid = 75;
constexpr std::uint8_t kHorizontalView = 16, kVerticalView = 17;
constexpr std::uint8_t kSensorAzimuth = 18, kSensorElevation = 19, kSensorRoll = 20;
constexpr std::uint8_t kSlantRange = 21;
constexpr std::uint8_t kCentreLatitude = 23, kCentreLongitude = 24, kCentreMsl = 25, kCentreEllipsoid = 78;
constexpr std::uint8_t kVersionOfSet = 65;
constexpr std::uint8_t kFirstCorner = 82;  // latitude, longitude, latitude, …

constexpr Mapping kCircle16 = unsigned_map(0.0, 360.0, 2), kCircle32 = unsigned_map(0.0, 360.0, 4);
constexpr Mapping kView = unsigned_map(0.0, 180.0, 2);
constexpr Mapping kHeight = unsigned_map(-900.0, 19000.0, 2);
constexpr Mapping kRange = unsigned_map(0.0, 5e6, 4);
constexpr Mapping kLatitude = signed_map(90.0, 4), kLongitude = signed_map(180.0, 4);
constexpr Mapping kSmallPitch = signed_map(20.0, 2), kSmallRoll = signed_map(50.0, 2);
constexpr Mapping kQuarter = signed_map(90.0, 4), kElevation = signed_map(180.0, 4);

double in_circle(double angle_deg) {
  return angle_deg - 360.0 * std::floor(angle_deg / 360.0);
}

double about_zero(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

void add_place(std::uint8_t latitude, std::uint8_t longitude, const Geodetic& place, LocalSet& set) {
  if (!is_valid(place)) return;
  set.add(latitude, place.latitude_deg, kLatitude);
  set.add(longitude, about_zero(place.longitude_deg), kLongitude);
}

void add_heights(std::uint8_t msl, std::uint8_t ellipsoid, const HeightReport& height, LocalSet& set) {
  if (height.msl_m) set.add(msl, *height.msl_m, kHeight);
  if (height.ellipsoid_m) set.add(ellipsoid, *height.ellipsoid_m, kHeight);
}

/// Usual angles in the items that every reader knows, larger ones in those for the full range.
void add_attitude(const ViewReport& view, LocalSet& set) {
  set.add(kHeading, in_circle(view.yaw_deg), kCircle16);
  if (holds(kSmallPitch, view.pitch_deg)) {
    set.add(kPitch, view.pitch_deg, kSmallPitch);
  } else {
    set.add(kFullPitch, view.pitch_deg, kQuarter);
  }
  if (holds(kSmallRoll, view.roll_deg)) {
    set.add(kRoll, view.roll_deg, kSmallRoll);
  } else if (holds(kQuarter, view.roll_deg)) {
    set.add(kFullRoll, view.roll_deg, kQuarter);
  } else if (std::isfinite(view.roll_deg)) {
    set.add_out_of_range(kFullRoll, kQuarter);
  }
}

void add_camera(const ViewReport& view, LocalSet& set) {
  add_place(kSensorLatitude, kSensorLongitude, view.camera, set);
  add_heights(kSensorMsl, kSensorEllipsoid, view.camera_height, set);
  set.add(kHorizontalView, view.sight.horizontal_view_deg, kView);
  set.add(kVerticalView, view.sight.vertical_view_deg, kView);
  set.add(kSensorAzimuth, in_circle(view.camera_in_vehicle.azimuth_deg), kCircle32);
  set.add(kSensorElevation, view.camera_in_vehicle.elevation_deg, kElevation);
  set.add(kSensorRoll, in_circle(view.camera_in_vehicle.roll_deg), kCircle32);
}

void add_ground(const ViewReport& view, LocalSet& set) {
  if (view.sight.range_m) set.add(kSlantRange, *view.sight.range_m, kRange);
  if (view.image_centre) {
    add_place(kCentreLatitude, kCentreLongitude, view.image_centre->position, set);
    add_heights(kCentreMsl, kCentreEllipsoid, view.ground_height, set);
  }
  if (!view.footprint) return;
  std::uint8_t tag = kFirstCorner;
  for (const GroundPoint& corner : *view.footprint) {
    add_place(tag, static_cast<std::uint8_t>(tag + 1), corner.position, set);
    tag = static_cast<std::uint8_t>(tag + 2);
  }
}

}  // namespace

std::string uas_datalink_set(const OutputFrame& frame) {
  LocalSet set;
  const auto since_1970 = std::chrono::floor<std::chrono::microseconds>(frame.captured_at.time_since_epoch());
  set.add_integer(kTimeStamp, static_cast<std::uint64_t>(since_1970.count()), sizeof(std::uint64_t));
  set.add_integer(kVersionOfSet, kVersion, 1);
  if (frame.view) {
    add_attitude(*frame.view, set);
    add_camera(*frame.view, set);
    add_ground(*frame.view, set);
  }
  return set.finish(kKey);
}

}  // namespace geoloc::io
