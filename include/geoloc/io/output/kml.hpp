// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// KML 2.2 with Google's track extension: a place and a 2-sigma ellipse per object, shown from when it was
/// first seen, and the time-stamped trajectory. Values that are not finite are left out.
std::string run_to_kml(const RunRecord& run);

}  // namespace geoloc::io
