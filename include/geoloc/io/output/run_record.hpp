// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/output/estimator_report.hpp"
#include "geoloc/io/output/flight_report.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/raw_fixes.hpp"

namespace geoloc::io {

/// The vehicle at a located frame.
struct TrajectoryPoint {
  HostTime at;
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();  ///< [m], up is the height above home
};

/// The whole run so far, as plain values for writing files.
struct RunRecord {
  std::string title;
  std::string summary;  ///< lines for a person
  std::vector<ObjectReport> objects;
  EstimatorReport estimator;
  std::optional<LocalFrame> local_frame;  ///< nullopt before the first position; then all lists are empty
  double ground_height_above_home_m = 0.0;
  std::vector<RawFix> raw_fixes;
  std::vector<TrajectoryPoint> trajectory;
  std::vector<Eigen::Vector2d> targets;  ///< true positions [m], where they are known
  /// For fusion with other flights: where it is asked for, and known.
  std::optional<FlightSummary> flight_summary;
  /// Of a fleet, whose objects these are; otherwise empty, and nullptr.
  std::vector<FlightReport> flights;
  std::shared_ptr<const FusedMap> fused_map;
  std::shared_ptr<const ObjectIds> object_ids;
};

}  // namespace geoloc::io
