// SPDX-License-Identifier: Apache-2.0
#include "calibration/node_history.hpp"

#include <cassert>

namespace geoloc {
namespace {

/// The first share that is free, or is that node's.
void add_share(NodeHistory::Blend& blend, const NodeHistory::Share& share) {
  for (NodeHistory::Share& own : blend.shares) {
    if (own.weight != 0.0 && own.serial != share.serial) continue;
    own = {share.serial, own.weight + share.weight};
    return;
  }
  assert(false);  // no more than two nodes are neighbours of one place
}

}  // namespace

std::uint32_t NodeHistory::append() {
  fate_of(size_) = Fate{};
  return size_++;
}

void NodeHistory::replace(std::uint32_t serial, const Blend& by) {
  fate_of(serial) = {true, by};
}

/// Each node that is followed remembers where it led, so that chains stay short.
NodeHistory::Blend NodeHistory::resolve(std::uint32_t serial) {
  Fate& fate = fate_of(serial);
  Blend found;
  if (!fate.is_gone) {
    found.shares[0] = {serial, 1.0};
    return found;
  }
  found.constant = fate.blend.constant;
  const auto stated = fate.blend.shares;
  for (const Share& share : stated) {
    if (share.weight == 0.0) continue;
    const Blend blend = resolve(share.serial);
    found.constant += share.weight * blend.constant;
    for (const Share& of_share : blend.shares) {
      if (of_share.weight != 0.0) add_share(found, {of_share.serial, share.weight * of_share.weight});
    }
  }
  fate.blend = found;
  return found;
}

}  // namespace geoloc
