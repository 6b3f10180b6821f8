// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "geoloc/calibration/flight_state.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// The confirmed objects at rest, with what they are off by together: object i is truly at
///   position_in_enu + (rows 3i to 3i+2 of shared_error) s + own noise,
/// where s are independent errors of the flight of variance one, the same for all objects. No less is known
/// of the objects than the estimator knows: every covariance, within an object and between two, follows.
struct JointEstimate {
  struct Object {
    Track track;
    Eigen::Vector3d position_in_enu;  ///< east, north, up above home [m]
    Eigen::Matrix3d own_covariance;   ///< of the own noise [m^2]
  };

  std::vector<Object> objects;  ///< in order of their ids
  /// Three rows (east, north, up) per object, a column per error [m].
  Eigen::MatrixXd shared_error;
  /// Objects, as places in the list, that a frame showed side by side: never one. The smaller one first.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;
  /// What another run over the same flight shares with this one: its shared errors are those of the objects.
  FlightState flight_state;
};

}  // namespace geoloc
