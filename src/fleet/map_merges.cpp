// SPDX-License-Identifier: Apache-2.0
#include "fleet/map_merges.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <utility>

#include "tracking/gaussian.hpp"
#include "tracking/place_index.hpp"

namespace geoloc {
namespace {

constexpr double kReach_m = 2.0;
/// Chi-square, 2 degrees of freedom, 95 %: for two objects of one part.
constexpr double kStrictGate = 5.99;

/// Horizontal, of the object among its neighbours.
Eigen::Matrix2d own_covariance(const std::vector<FlightModel>& flights, const Members& members) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const Contribution& member : members)
    information += flights[member.flight].objects[member.object].own_information;
  return information.inverse().topLeftCorner<2, 2>();
}

enum class Kinship { kNone, kOnePart, kApart };

/// Whether a part of a flight has objects in both, and whether it saw them side by side.
Kinship kinship(const FusionInput& input, const Members& a, const Members& b) {
  Kinship found = Kinship::kNone;
  for (const Contribution& of_a : a) {
    for (const Contribution& of_b : b) {
      if (of_a.flight != of_b.flight) continue;
      const FlightPart& part = input.part_of(of_a);
      if (!part.has(of_b.object)) continue;
      const std::size_t one = of_a.object - part.first_object, other = of_b.object - part.first_object;
      const auto [first, second] = std::minmax(one, other);
      const auto& apart = input.summaries[part.summary].apart;
      const std::pair pair(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second));
      if (std::binary_search(apart.begin(), apart.end(), pair)) return Kinship::kApart;
      found = Kinship::kOnePart;
    }
  }
  return found;
}

}  // namespace

bool merge_neighbours(const FusionInput& input, const MapEstimate& estimate, const FusionConfig& config,
                      std::vector<Members>& objects) {
  PlaceIndex index(kReach_m);
  std::vector<Eigen::Matrix2d> own;
  for (const Members& members : objects) own.push_back(own_covariance(input.models, members));
  const auto position = [&](std::uint32_t key) -> Eigen::Vector2d {
    return estimate.objects[key].position.head<2>();
  };
  const Eigen::Matrix2d of_object =
      2.0 * config.sigma_object_m * config.sigma_object_m * Eigen::Matrix2d::Identity();
  bool has_merged = false;
  for (std::uint32_t key = 0; key < objects.size(); ++key) {
    const Eigen::Vector2d here = position(key), reach(kReach_m, kReach_m);
    std::uint32_t nearest = key;
    double least = config.gate;
    index.for_each_near({here - reach, here + reach}, [&](std::uint32_t other) {
      const double chi2 =
          mahalanobis_squared(Eigen::Vector2d(position(other) - here), own[other] + own[key] + of_object);
      if (!(chi2 < least)) return;
      const Kinship kin = kinship(input, objects[other], objects[key]);
      if (kin == Kinship::kApart || (kin == Kinship::kOnePart && chi2 > kStrictGate)) return;
      least = chi2;
      nearest = other;
    });
    if (nearest == key) {
      index.insert(key, here);
      continue;
    }
    objects[nearest].insert(objects[nearest].end(), objects[key].begin(), objects[key].end());
    objects[key].clear();
    has_merged = true;
  }
  drop_empty(objects);
  return has_merged;
}

}  // namespace geoloc
