// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// GPX 1.1, for hand-held receivers and map programs: a waypoint per object, and the trajectory as a track.
/// Elevations are above mean sea level, where that is known. Values that are not finite are left out.
std::string run_to_gpx(const RunRecord& run);

}  // namespace geoloc::io
