// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/scene.hpp"

#include <algorithm>
#include <array>

#include "appearance.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {
namespace {

struct SizeRange {
  ObjectKind kind;
  double least_m;
  double most_m;
};

constexpr std::array<SizeRange, kDistractorKinds> kDistractors{{
    {ObjectKind::kDrainCover, 0.5, 0.9},
    {ObjectKind::kTyre, 0.55, 1.0},
    {ObjectKind::kWhitePanel, 0.4, 1.2},
    {ObjectKind::kBlackPanel, 0.4, 1.2},
    {ObjectKind::kCross, 0.5, 1.5},
    {ObjectKind::kRing, 0.5, 1.5},
    {ObjectKind::kDisc, 0.3, 1.0},
    {ObjectKind::kChecker, 0.5, 1.2},
    {ObjectKind::kStone, 0.2, 0.9},
    {ObjectKind::kRoadLine, 2.0, 6.0},
    {ObjectKind::kBush, 0.6, 2.5},
    {ObjectKind::kWheel, 0.5, 0.9},
    {ObjectKind::kManhole, 0.5, 0.9},
    {ObjectKind::kArrow, 0.8, 3.0},
    {ObjectKind::kQuarteredDisc, 0.4, 1.2},
    {ObjectKind::kBullseye, 0.5, 1.2},
}};

PlacedObject random_distractor(const Eigen::AlignedBox2d& area_in_enu, int kinds, Random& random) {
  const SizeRange& range = kDistractors[static_cast<std::size_t>(random.index(kinds))];
  PlacedObject object;
  object.kind = range.kind;
  object.position_in_enu.x() = random.uniform(area_in_enu.min().x(), area_in_enu.max().x());
  object.position_in_enu.y() = random.uniform(area_in_enu.min().y(), area_in_enu.max().y());
  object.heading_rad = random.uniform(-kPi, kPi);
  object.size_m = random.uniform(range.least_m, range.most_m);
  object.look = static_cast<std::uint32_t>(random.index(1 << 30));
  return object;
}

/// By the circles around both.
bool overlap(const PlacedObject& a, const PlacedObject& b) {
  const double reach_m = half_extent_m(a).norm() + half_extent_m(b).norm();
  return (a.position_in_enu - b.position_in_enu).norm() < reach_m;
}

}  // namespace

std::vector<PlacedObject> make_distractors(int count, const Eigen::AlignedBox2d& area_in_enu,
                                           const std::vector<PlacedObject>& keep_clear_of, std::uint64_t seed,
                                           int kinds) {
  constexpr int kTriesEach = 20;
  Random random(seed);
  std::vector<PlacedObject> placed;
  for (int tries = 0; tries < count * kTriesEach && static_cast<int>(placed.size()) < count; ++tries) {
    const PlacedObject candidate = random_distractor(area_in_enu, kinds, random);
    const auto hits = [&](const PlacedObject& other) { return overlap(candidate, other); };
    if (std::any_of(keep_clear_of.begin(), keep_clear_of.end(), hits)) continue;
    if (std::any_of(placed.begin(), placed.end(), hits)) continue;
    placed.push_back(candidate);
  }
  return placed;
}

}  // namespace geoloc::sim
