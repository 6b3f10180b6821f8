// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// KML 2.2 with Google's track extension: a place and a 2-sigma ellipse for each object, from when it was
/// first seen, and the trajectory with its times. What is not finite is left out.
std::string run_to_kml(const RunRecord& run);

}  // namespace geoloc::io
