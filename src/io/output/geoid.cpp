// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/geoid.hpp"

#include <GeographicLib/Geoid.hpp>
#include <cmath>

namespace geoloc::io {

Geoid::Geoid(const std::string& folder) {
  for (const char* name : {"egm96-5", "egm96-15"}) {
    try {
      geoid_ = std::make_unique<GeographicLib::Geoid>(name, folder);
      return;
    } catch (const GeographicLib::GeographicErr&) {  // not installed
    }
  }
}

Geoid::~Geoid() = default;

std::optional<double> Geoid::height_ellipsoid_m(const Geodetic& position, double height_msl_m) const {
  if (!geoid_ || !is_valid(position) || !std::isfinite(height_msl_m)) return std::nullopt;
  try {
    return height_msl_m + (*geoid_)(position.latitude_deg, position.longitude_deg);
  } catch (const GeographicLib::GeographicErr&) {  // the file is damaged, or gone
    return std::nullopt;
  }
}

}  // namespace geoloc::io
