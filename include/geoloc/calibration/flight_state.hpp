// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// An unknown that outlasts a run of the estimator: another run over the same flight has the same one, or
/// one that it continues. In the units of CalibrationIndex; the drift is in metres, its yaw in radians.
enum class FlightUnknown : std::uint8_t {
  kBoresightX,
  kBoresightY,
  kBoresightZ,
  kLatency,
  kHeight,
  kFocal,
  kPositionLag,
  kOffsetEast,
  kOffsetNorth,
  kFirstDriftEast,  ///< at the drift's first node
  kFirstDriftNorth,
  kFirstDriftUp,
  kFirstDriftYaw,
  kLastDriftEast,  ///< at its last node
  kLastDriftNorth,
  kLastDriftUp,
  kLastDriftYaw
};

inline constexpr std::size_t kFlightUnknowns = 17;

inline bool is_constant(FlightUnknown unknown) {
  return unknown < FlightUnknown::kFirstDriftEast;
}
inline bool is_first_drift(FlightUnknown unknown) {
  return !is_constant(unknown) && unknown < FlightUnknown::kLastDriftEast;
}

/// How the drift's components are correlated in time, as DriftConfig has it.
struct DriftCorrelation {
  double position_time_constant_s = 100.0;
  double ripple_share = 0.2;
  double ripple_time_constant_s = 3.0;
  double up_time_constant_s = 30.0;
  double yaw_time_constant_s = 60.0;
};

/// What a run of the estimator found of the unknowns that outlast it: unknown i is truly
///   mean + (row i of shared_error) s
/// with the s of the run's objects (JointEstimate) in the first columns, and errors of variance one that
/// concern no object in the others. Without the prior, which another run over the same flight began with,
/// too, it is what the looks of this run tell of them.
struct FlightState {
  struct Unknown {
    FlightUnknown which = FlightUnknown::kBoresightX;
    double mean = 0.0;
    double prior_mean = 0.0;
    double prior_sigma = 1.0;  ///< 1-sigma; of the drift that of any time
  };

  std::vector<Unknown> unknowns;  ///< in the order of FlightUnknown, each once
  Eigen::MatrixXd shared_error;   ///< a row per unknown
  VehicleTime first_node_at;      ///< times of the drift's first and last node
  VehicleTime last_node_at;
  DriftCorrelation drift;
};

}  // namespace geoloc
