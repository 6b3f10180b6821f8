// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::io {

/// Where a point of PX4's local plane is: azimuths and distances from its reference are true, on a sphere.
Geodetic from_px4_plane(const Geodetic& reference, double north_m, double east_m);

}  // namespace geoloc::io
