// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fleet/map_places.hpp"
#include "fleet/relative_objects.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc {

/// A flight laid onto a sheet of the map: its objects, moved by the shift, are where the map has them.
struct LaidFlight {
  std::uint32_t sheet = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< from the flight to the sheet [m]
  double score = 0.0;  ///< logarithm of how much likelier the flight is to be there than elsewhere
};

/// The best shift of the flight against each sheet that it may lie on, best first; sheets on which it fits no
/// better than by chance are left out.
std::vector<LaidFlight> find_shifts(const RelativeObjects& flight, const std::vector<int>& classes,
                                    const MapPlaces& places, const FusionConfig& config);

}  // namespace geoloc
