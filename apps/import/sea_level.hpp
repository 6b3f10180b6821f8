// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::apps {

/// A height above the ellipsoid as one above the sea. Without a geoid it stays as it is, which is added to
/// `assumptions` after the `fact` that such heights count from the ellipsoid.
double height_msl_m(const Geodetic& position, double height_ellipsoid_m, const std::string& fact,
                    std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
