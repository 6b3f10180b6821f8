// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::io {

/// One located detection, kept for the record.
struct RawFix {
  HostTime captured_at;
  Detection detection;
  Eigen::Vector2d position_in_enu;
  double range_m;
};

/// CSV with a header line: time, latitude and longitude [deg], east and north [m], range, class, confidence,
/// box.
std::string raw_fixes_to_csv(const std::vector<RawFix>& fixes, const LocalFrame& frame);

}  // namespace geoloc::io
