// SPDX-License-Identifier: Apache-2.0
#include "calibration/node_history.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// The first share that is free, or is that node's.
void add_share(NodeHistory::Blend& blend, const NodeHistory::Share& share) {
  if (share.weight == 0.0) return;
  for (NodeHistory::Share& own : blend.shares) {
    if (own.weight != 0.0 && own.serial != share.serial) continue;
    own = {share.serial, own.weight + share.weight};
    return;
  }
  assert(false);  // no more than two nodes are neighbours of one place
}

/// Puts `by` in the place of a node.
void substitute(std::uint32_t gone, const NodeHistory::Blend& by, NodeHistory::Blend& blend) {
  for (NodeHistory::Share& share : blend.shares) {
    if (share.weight == 0.0 || share.serial != gone) continue;
    const double weight = std::exchange(share.weight, 0.0);
    blend.constant += weight * by.constant;
    for (const NodeHistory::Share& heir : by.shares) add_share(blend, {heir.serial, weight * heir.weight});
    return;
  }
}

}  // namespace

NodeHistory::NodeHistory() {
  take_room(this);
  std::fill(chains_.begin(), chains_.end(), kNone);
}

std::size_t NodeHistory::take_room(NodeHistory* self) {
  return room::resize(self, &NodeHistory::fates_, kRemembered) +
         room::resize(self, &NodeHistory::chains_, kRemembered);
}

void NodeHistory::replace(std::uint32_t serial, const Blend& by) {
  for (Fate& fate : fates_) substitute(serial, by, fate.blend);
  const std::uint32_t place = oldest_;
  oldest_ = (oldest_ + 1) % kRemembered;
  forget(place);
  fates_[place] = {serial, std::exchange(chain_of(serial), place), by};
}

void NodeHistory::forget(std::uint32_t place) {
  const Fate& gone = fates_[place];
  if (gone.serial == kNone) return;
  std::uint32_t* link = &chain_of(gone.serial);
  while (*link != place) link = &fates_[*link].next;
  *link = gone.next;
}

NodeHistory::Blend NodeHistory::resolve(std::uint32_t serial) const {
  for (std::uint32_t place = chains_[serial % kRemembered]; place != kNone; place = fates_[place].next) {
    if (fates_[place].serial == serial) return fates_[place].blend;
  }
  Blend itself;
  itself.shares[0] = {serial, 1.0};
  return itself;
}

}  // namespace geoloc
