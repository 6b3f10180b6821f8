// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/tracking/known_points.hpp"

namespace geoloc::apps {

/// Some targets of a run as a survey gives them, and the rest, which are scored.
struct Survey {
  std::vector<KnownPoint> points;
  std::vector<io::TrueTarget> told;  ///< where they truly are
  std::vector<io::TrueTarget> others;
};

/// Draws `count` targets; their coordinates are off by 5 cm, 1-sigma per axis.
Survey make_survey(std::vector<io::TrueTarget> targets, int count, std::uint64_t seed,
                   const LocalFrame& frame);

}  // namespace geoloc::apps
