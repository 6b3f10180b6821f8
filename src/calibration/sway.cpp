// SPDX-License-Identifier: Apache-2.0
#include "calibration/sway.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// As many as the looks that are linearised anew may lie in (OpeningLooks).
constexpr std::size_t kRemembered = 256;

}  // namespace

SwayTimeline::SwayTimeline(const DriftConfig& config)
    : parts_between_nodes_(
          std::max(1, static_cast<int>(std::lround(config.node_spacing_s / config.spell_s)))),
      max_spells_(config.max_spells),
      time_constant_s_(config.sway_time_constant_s) {
  take_room(this);
}

std::size_t SwayTimeline::take_room(SwayTimeline* self) {
  return room::resize(self, &SwayTimeline::spells_, kRemembered);
}

std::uint32_t SwayTimeline::cover(VehicleTime time, std::uint32_t node, double share) {
  if (max_spells_ == 0) return kNoSpell;
  const int part = std::clamp(static_cast<int>(share * parts_between_nodes_), 0, parts_between_nodes_ - 1);
  if (size() > 0) {
    const Spell& newest = spell(end_ - 1);
    if (newest.node == node && newest.part >= part) return end_ - 1;
  }
  Spell next;
  next.begin = time;
  next.node = node;
  next.part = part;
  if (size() > 0) {
    const Spell& before = spell(end_ - 1);
    next.transition = std::exp(-std::abs(seconds(time - before.begin)) / time_constant_s_);
    next.innovation_share = std::max(1e-6, 1.0 - next.transition * next.transition);
    next.mean = next.transition * before.mean;
    next.per_focal = next.transition * before.per_focal;
    next.focal = before.focal;
  }
  spell(end_) = next;
  return end_++;
}

void SwayTimeline::freeze_oldest() {
  const Spell& frozen = spell(begin_);
  Spell& heir = spell(begin_ + 1);
  const SwayVector by_focal = frozen.per_focal - frozen.prior_per_focal;
  const SwayVector weighted = information(begin_).cwiseProduct(by_focal);
  of_focal_.information += weighted.dot(by_focal);
  of_focal_.vector -= weighted.dot(frozen.constant() - frozen.prior_mean);
  heir.prior_mean = heir.transition * frozen.constant();
  heir.prior_per_focal = heir.transition * frozen.per_focal;
  heir.transition = 0.0;
  ++begin_;
}

}  // namespace geoloc
