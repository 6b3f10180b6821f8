// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/object_note.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::io {

/// 1-sigma ellipse of a horizontal position.
struct ErrorEllipse {
  double sigma_major_m = 0.0;
  double sigma_minor_m = 0.0;
  double azimuth_deg = 0.0;  ///< of the major axis, from true north, clockwise, in [0, 180)
};

/// Size at which ellipses are drawn in pictures and on maps.
inline constexpr double kDrawnSigmas = 2.0;

ErrorEllipse error_ellipse(const Eigen::Matrix2d& covariance);

/// Speed and course over ground when last seen.
struct Course {
  double speed_mps = 0.0;
  double direction_deg = 0.0;  ///< from true north, clockwise, in [0, 360)
};

Course course_of(const Eigen::Vector2d& velocity_in_enu);

/// Height of an object.
struct HeightReport {
  double above_home_m = 0.0;      ///< above the vehicle's home at the flight's start
  std::optional<double> sigma_m;  ///< where the method estimates heights; otherwise it is the ground's as set
  std::optional<double> msl_m;    ///< above mean sea level, where home's is known
  std::optional<double> ellipsoid_m;  ///< above the WGS84 ellipsoid, where the geoid is known, too (Geoid)
};

/// What every output reports about an object.
struct ObjectReport {
  std::uint64_t id = 0;
  int class_id = 0;
  std::string class_name;
  double confidence = 0.0;
  int hits = 0;
  HostTime first_seen;
  HostTime last_seen;
  Geodetic position;
  Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_in_enu = Eigen::Matrix2d::Zero();  ///< east, north [m^2]
  ErrorEllipse ellipse;
  HeightReport height;
  std::optional<Course> course;  ///< of objects of moving classes
  ObjectNote note;               ///< an operator's
};

HeightReport height_of(const Track& track, const Geolocator& geolocator);

/// The objects with that status in order of their ids.
std::vector<ObjectReport> report_objects(const Geolocator& geolocator,
                                         const std::vector<std::string>& class_names,
                                         TrackStatus status = TrackStatus::kConfirmed);

/// The same in place of what `reports` holds: those whose tracks have not changed since are kept.
void update_reports(const Geolocator& geolocator, const std::vector<std::string>& class_names,
                    TrackStatus status, std::vector<ObjectReport>& reports);

/// The name of a class; a class without one is called by its number.
std::string class_name_of(int class_id, const std::vector<std::string>& class_names);

/// Whether its position is finite and on the globe; an object without one is in no output.
bool has_place(const ObjectReport& object);

/// UTC, ISO 8601 with milliseconds: 2026-11-22T09:30:00.123Z.
std::string iso8601(HostTime time);

}  // namespace geoloc::io
