// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geoloc.h"
#include "geoloc/geoloc.hpp"

// C's structures of the library's values.
namespace geoloc::c {

geoloc_outcome to_c(const FrameOutcome& outcome);
geoloc_object to_c(const Track& track, const LocalFrame& frame);
geoloc_fix to_c(const LocatedDetection& located, const LocalFrame& frame);
geoloc_pose to_c(const FrameView& view);
geoloc_calibration to_c(const Calibration& calibration);
geoloc_counters counters_of(const Geolocator& geolocator);

}  // namespace geoloc::c
