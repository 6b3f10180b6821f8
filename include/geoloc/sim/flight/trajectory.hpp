// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc::sim {

/// Where the vehicle truly was: a row of a truth file.
struct TrueState {
  VehicleTime time;
  Geodetic position;
  double height_msl_m = 0.0;
  EulerAngles attitude;  ///< yaw from true north
};

/// The ground the flights were flown over (data/flights/README.md): flat, at this height.
struct Site {
  Geodetic home{-22.9060, -43.1330};
  double ground_height_msl_m = 10.0;
};

struct TimeSpan {
  VehicleTime begin;
  VehicleTime end;
};

/// The true pose at any time of a flight, in the local frame whose origin is home and whose up is the height
/// above the ground. Between the samples the position goes straight and the attitude along the shortest turn.
class Trajectory {
 public:
  /// Throws std::invalid_argument unless there are two samples at least, their times rise and all values are
  /// finite.
  Trajectory(const std::vector<TrueState>& states, const Site& site);

  /// enu_from_body; nullopt outside span().
  std::optional<Rigid3d> pose(VehicleTime time) const;

  TimeSpan span() const { return {times_.front(), times_.back()}; }

  /// From when the vehicle first reached 95 % of its greatest height to when it last left it: the survey.
  TimeSpan survey() const { return survey_; }

  /// The same flight so much higher; its survey stays what it was.
  Trajectory raised(double metres) const;

  /// The same places with the same tilts `factor` times as fast: every time of the vehicle's clock is
  /// divided.
  Trajectory at_speed(double factor) const;

  const LocalFrame& frame() const { return frame_; }

 private:
  TimeSpan find_survey() const;

  LocalFrame frame_;
  std::vector<VehicleTime> times_;
  std::vector<Rigid3d> enu_from_body_;
  TimeSpan survey_;
};

}  // namespace geoloc::sim
