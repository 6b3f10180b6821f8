// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "geoloc/state/samples.hpp"

namespace geoloc::apps {

/// Length of a degree of latitude and, at the equator, of longitude.
inline constexpr double kMetresPerDegree = 111'319.5;

/// From one position to another, in east, north, up [m], near enough to each other for a plane.
Eigen::Vector3d way(const PositionSample& from, const PositionSample& to);

}  // namespace geoloc::apps
