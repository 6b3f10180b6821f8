// SPDX-License-Identifier: Apache-2.0
#include "import/sea_level.hpp"

#include "common/geoid_data.hpp"

namespace geoloc::apps {

double height_msl_m(const Geodetic& position, double height_ellipsoid_m, const std::string& fact,
                    std::vector<std::string>& assumptions) {
  const auto undulation_m = open_geoid().height_ellipsoid_m(position, 0.0);
  if (undulation_m) return height_ellipsoid_m - *undulation_m;
  assumptions.push_back(fact +
                        ", and there is no geoid on this computer to convert them: heights above sea level "
                        "in the outputs are those above the ellipsoid");
  return height_ellipsoid_m;
}

}  // namespace geoloc::apps
