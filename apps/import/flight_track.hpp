// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/logs/flight_log.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::apps {

/// What the command line says where a log says nothing.
struct TrackFacts {
  std::optional<double> utc_offset_h;       ///< what the camera's clock is ahead of UTC
  std::optional<double> take_off_height_m;  ///< in the datum of the log's absolute heights
  std::optional<double> camera_pitch_deg;   ///< of a camera that a gimbal holds level; -90 is down
};

/// A log as an autopilot would have told it. Times are the log's.
struct FlightTrack {
  std::vector<AttitudeSample> attitudes;
  std::vector<PositionSample> positions;  ///< each with heights and a velocity
  std::vector<io::LoggedFix> fixes;
  std::vector<io::LoggedGimbal> gimbal;          ///< as the log tells it
  std::vector<io::LoggedGimbal> assumed_gimbal;  ///< where it tells none: level ones, each from north
  VehicleTime begin;                             ///< of the first sample of the vehicle's state
  VehicleTime end;
  Duration utc_since_log{};  ///< what UTC is ahead of the log's clock
  bool is_utc_known = false;
  double sigma_attitude_deg = 0.0;  ///< of angles that were assumed; 0: all are told
  bool is_heading_assumed = false;
  std::vector<std::string> notes;        ///< how good the log is
  std::vector<std::string> assumptions;  ///< what was not told, and what was taken instead
};

/// Throws std::runtime_error where one fact is missing that only the user knows, or the log is of no flight.
FlightTrack track_of(io::FlightLog log, const TrackFacts& facts);

}  // namespace geoloc::apps
