// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::io {

/// A position (WGS84) in the notations that people copy into other tools.
struct CoordinateTexts {
  std::string degrees;  ///< "-22.90612346, -43.13398765"
  std::string dms;      ///< "22°54′22.044″S 43°08′02.356″W"
  std::string utm;      ///< "23K 691442.11 7465634.07": zone and latitude band, easting, northing [m]
  std::string mgrs;     ///< "23KPQ9144265634", to the metre
};

/// All four are empty for coordinates that are not on Earth.
CoordinateTexts coordinate_texts(const Geodetic& place);

}  // namespace geoloc::io
