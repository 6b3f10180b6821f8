// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace geoloc::sim {

inline constexpr int kScenarioCount = 3;
inline constexpr int kTargetCount = 30;

/// Half the extent of the targets' area about home [m]: what the camera sees well on every path of
/// data/flights. The lanes span 80 m x 60 m, but the expanding square of path 6 leaves out the eastern and
/// western edges.
inline constexpr double kAreaHalfEast_m = 34.0;
inline constexpr double kAreaHalfNorth_m = 27.0;

/// No two targets of a scenario are closer than this [m].
inline constexpr double kClosestPair_m = 1.2;

/// East and north of home [m] of 30 targets, as in figure 6 of the paper: 1 spread over the area, 2 tight
/// clusters whose closest pairs are kClosestPair_m apart, 3 a regular grid. Throws std::invalid_argument for
/// another number.
std::vector<Eigen::Vector2d> make_scenario(int number, std::uint64_t seed);

/// As many targets in pairs: the two of a pair `distance_m` apart in a random direction, pairs far from each
/// other. Throws std::invalid_argument for a distance outside (0, 5] m.
std::vector<Eigen::Vector2d> make_pairs(double distance_m, std::uint64_t seed);

}  // namespace geoloc::sim
