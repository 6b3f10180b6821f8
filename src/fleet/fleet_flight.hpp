// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "fleet/flight_model.hpp"

namespace geoloc {

/// The objects of a flight that one summary tells of.
struct FlightPart {
  std::size_t summary = 0;       ///< place among the summaries
  std::size_t first_object = 0;  ///< of the flight's model, in the order of the summary
  std::size_t objects = 0;
  Eigen::Matrix<double, 3, Eigen::Dynamic> shift;  ///< how they move per error, in the mean [m]
  /// By how much the other parts have moved them, in the mean.
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();

  bool has(std::size_t object) const { return object >= first_object && object < first_object + objects; }
};

/// A flight of one summary or more, as the fusion takes it.
struct FleetFlight {
  FlightModel model;
  std::vector<FlightPart> parts;
};

/// A flight of one summary.
inline FleetFlight flight_of(std::size_t summary, FlightModel model) {
  FlightPart part{summary, 0, model.objects.size(), model.shift};
  return {std::move(model), {std::move(part)}};
}

}  // namespace geoloc
