// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace geoloc::io {

/// What a fleet's map made of one of its flights, as plain values for people.
struct FlightReport {
  std::string flight;
  std::string vehicle;
  std::uint64_t sequence = 0;
  std::string verdict;  ///< "fused", "quarantined" and so on
  std::string reason;   ///< of all but "fused", and which other flights are parts of one with it
  /// Reported minus estimated, in common of all its objects: east, north, up [m].
  Eigen::Vector3d common_error_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();
  double chi2 = 0.0;
  std::size_t objects = 0;
  std::size_t shared_objects = 0;
  std::vector<Eigen::Vector2d>
      places_in_enu;  ///< where the flight itself has its objects, in the map's frame
};

}  // namespace geoloc::io
