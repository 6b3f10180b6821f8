// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fleet/fusion_input.hpp"
#include "fleet/map_solver.hpp"

namespace geoloc {

/// What the objects of a part of a flight are off by in common, as all flights together show it.
struct PartError {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();  ///< reported minus estimated: east, north, up
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();
  std::size_t shared_objects = 0;  ///< with other flights
};

/// The same of a flight, of which its parts are no witnesses.
struct CommonError {
  /// Reported minus estimated, as the flight's parts together have it: what other flights say.
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  /// Chi-square of the horizontal part against what the other flights say, 2 degrees of freedom; 0: they say
  /// nothing. The sum over objects would hide it.
  double chi2 = 0.0;
  std::size_t other_flights = 0;  ///< that share objects with it, up to two
  std::vector<PartError> parts;
};

std::vector<CommonError> common_errors(const FusionInput& input, const std::vector<Members>& objects,
                                       const MapEstimate& estimate);

}  // namespace geoloc
