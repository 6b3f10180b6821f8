// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double distance_to_nearest(const Points& points, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& other : points) nearest = std::min(nearest, (other - point).norm());
  return nearest;
}

Eigen::Vector2d draw_in_area(Random& random, double margin_m) {
  const double east = random.uniform(margin_m - kAreaHalfEast_m, kAreaHalfEast_m - margin_m);
  const double north = random.uniform(margin_m - kAreaHalfNorth_m, kAreaHalfNorth_m - margin_m);
  return {east, north};
}

/// Random places that keep a distance, by dart throwing. It ends: the discs about count - 1 places are too
/// small to cover the area, whatever the places (the thinnest covering has density 1.209).
Points scatter(int count, double distance_m, double margin_m, Random& random) {
  Points points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const Eigen::Vector2d point = draw_in_area(random, margin_m);
    if (distance_to_nearest(points, point) >= distance_m) points.push_back(point);
  }
  return points;
}

Points spread(Random& random) {
  constexpr double kDistance_m = 6.0;
  return scatter(kTargetCount, kDistance_m, 0.0, random);
}

Eigen::Vector2d offset(double distance_m, Random& random) {
  const double direction = random.uniform(-kPi, kPi);
  return {distance_m * std::cos(direction), distance_m * std::sin(direction)};
}

/// No target of a cluster is further from its first one [m].
constexpr double kClusterReach_m = 4.0;

/// The first two as close as targets may be, each further one beside any of those before it.
Points cluster(const Eigen::Vector2d& start, int count, Random& random) {
  constexpr double kLoosest_m = 2.0;
  Points points{start, start + offset(kClosestPair_m, random)};
  while (points.size() < static_cast<std::size_t>(count)) {
    const auto neighbour = static_cast<std::size_t>(random.index(static_cast<int>(points.size())));
    const Eigen::Vector2d point =
        points[neighbour] + offset(random.uniform(kClosestPair_m, kLoosest_m), random);
    const bool within_reach = (point - start).norm() <= kClusterReach_m;
    if (within_reach && distance_to_nearest(points, point) >= kClosestPair_m) points.push_back(point);
  }
  return points;
}

Points clusters(Random& random) {
  constexpr int kClusters = 6;
  constexpr double kDistance_m = 14.0;
  Points points;
  for (const Eigen::Vector2d& start : scatter(kClusters, kDistance_m, kClusterReach_m, random)) {
    const Points close = cluster(start, kTargetCount / kClusters, random);
    points.insert(points.end(), close.begin(), close.end());
  }
  return points;
}

Points grid(Random& random) {
  constexpr int kColumns = 6, kRows = 5;
  static_assert(kColumns * kRows == kTargetCount);
  constexpr double kPlay_m = 1.0;  // the whole grid is shifted by up to this, so that seeds differ
  const double east_step_m = 2.0 * (kAreaHalfEast_m - kPlay_m) / (kColumns - 1);
  const double north_step_m = 2.0 * (kAreaHalfNorth_m - kPlay_m) / (kRows - 1);
  const double east_shift_m = random.uniform(-kPlay_m, kPlay_m);
  const double north_shift_m = random.uniform(-kPlay_m, kPlay_m);
  Points points;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      points.emplace_back(east_shift_m + (column - 0.5 * (kColumns - 1)) * east_step_m,
                          north_shift_m + (row - 0.5 * (kRows - 1)) * north_step_m);
    }
  }
  return points;
}

}  // namespace

Points make_scenario(int number, std::uint64_t seed) {
  Random random(stream_seed(seed, RandomStream::kScenario));
  switch (number) {
    case 1:
      return spread(random);
    case 2:
      return clusters(random);
    case 3:
      return grid(random);
    default:
      throw std::invalid_argument("scenario " + std::to_string(number) + " is not 1, 2 or 3");
  }
}

Points make_pairs(double distance_m, std::uint64_t seed) {
  constexpr double kWidest_m = 5.0;
  constexpr double kBetweenPairs_m = 8.0;
  if (!(distance_m > 0.0 && distance_m <= kWidest_m)) {
    throw std::invalid_argument("the targets of a pair must stand in (0, 5] m from each other");
  }
  Random random(stream_seed(seed, RandomStream::kScenario));
  Points points;
  for (const Eigen::Vector2d& middle : scatter(kTargetCount / 2, kBetweenPairs_m, 0.5 * kWidest_m, random)) {
    const Eigen::Vector2d half = offset(0.5 * distance_m, random);
    points.push_back(middle - half);
    points.push_back(middle + half);
  }
  return points;
}

}  // namespace geoloc::sim
