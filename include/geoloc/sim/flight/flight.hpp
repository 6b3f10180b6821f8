// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/recording/tlog.hpp"
#include "geoloc/sim/flight/gimbal_trajectory.hpp"
#include "geoloc/sim/flight/trajectory.hpp"
#include "geoloc/sim/flight/zoom_trajectory.hpp"

namespace geoloc::sim {

/// A flight that was flown: what the autopilot said (`NAME.tlog`) and where it truly was
/// (`NAME_truth.csv.gz`).
struct Flight {
  std::string name;
  io::Tlog telemetry;
  Trajectory truth;
  HostTime booted_at;  ///< on the clock of the log's stamps: when the vehicle's clock read zero
  std::optional<GimbalTrajectory> gimbal = std::nullopt;  ///< what carries the camera; unset: the body
  std::optional<ZoomTrajectory> zoom = std::nullopt;      ///< unset: it does not

  /// The camera's true pose, by that in the body or, on a gimbal, in its axes; nullopt outside the truth.
  std::optional<Rigid3d> enu_from_camera(VehicleTime time, const Rigid3d& carrier_from_camera) const;

  /// How far it has zoomed in; 1 is its calibration.
  double zoom_at(VehicleTime time) const { return zoom ? zoom->zoom(time) : 1.0; }

  HostTime host_time(VehicleTime time) const { return booted_at + time.time_since_epoch(); }
};

/// Throws std::runtime_error: for an unknown name it lists those that `folder` holds.
Flight load_flight(const std::filesystem::path& folder, const std::string& name, const Site& site = {});

/// Names of the flights in a folder, sorted; empty where there is no such folder.
std::vector<std::string> flight_names(const std::filesystem::path& folder);

/// The folder of flights: `given`, else share/geoloc/flights of the prefix `program` is installed in, else
/// data/flights of the source tree it was built in or of the working directory. Throws std::runtime_error
/// naming where it looked.
std::filesystem::path find_flights(const std::optional<std::filesystem::path>& given,
                                   const std::filesystem::path& program);

}  // namespace geoloc::sim
