// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::io {

/// What a detection is taken to show.
struct Look {
  std::optional<std::uint64_t> object_id;      ///< nullopt: no object, or not decided yet
  std::optional<Eigen::Vector2d> expected_px;  ///< where the object was expected, pixel centres at integers;
                                               ///< nullopt where it is new
};

/// From where the object was expected to the centre of the box [px]; nullopt without the former.
std::optional<Eigen::Vector2d> innovation_px(const Look& look, const Detection& detection);

/// One located detection, kept for the record.
struct RawFix {
  HostTime captured_at;
  Detection detection;
  Eigen::Vector2d position_in_enu;
  double range_m;
  std::uint64_t frame = 0;  ///< its number in the run, from 0
  Look look = {};
};

/// CSV with a header line: time, latitude and longitude [deg], east and north [m], range, class, confidence,
/// box, frame, object, expected pixel, innovation. What is not known is empty.
std::string raw_fixes_to_csv(const std::vector<RawFix>& fixes, const LocalFrame& frame);

}  // namespace geoloc::io
