// SPDX-License-Identifier: Apache-2.0
#include "tracking/head_bound.hpp"

namespace geoloc {
namespace {

void freeze_oldest_spell(DriftTimeline& drift, TrackTable& tracks) {
  for (RestingObject& track : tracks) track.landmark->freeze_spell(drift.sway().begin(), drift);
  drift.sway().freeze_oldest();
}

void freeze_oldest_node(DriftTimeline& drift, HeightLog& heights, TrackTable& tracks) {
  for (RestingObject& track : tracks) track.landmark->freeze(drift.begin(), drift);
  heights.freeze_oldest(drift);
  drift.freeze_oldest();
}

/// Spells lie between the nodes that they were made with.
void thin(const ThinnedNode& node, DriftTimeline& drift, HeightLog& heights, TrackTable& tracks) {
  const SwayTimeline& sway = drift.sway();
  while (sway.size() > 1 && sway.spell(sway.begin()).node <= node.number) freeze_oldest_spell(drift, tracks);
  for (RestingObject& track : tracks) track.landmark->thin(node, drift);
  heights.thin(node);
  drift.thin(node);
}

}  // namespace

bool bound_head(const DriftConfig& config, DriftTimeline& drift, HeightLog& heights, TrackTable& tracks) {
  while (drift.sway().is_full()) freeze_oldest_spell(drift, tracks);
  if (drift.size() <= config.max_nodes) return false;
  while (drift.size() > config.max_nodes) {
    if (const auto node = drift.next_to_thin()) {
      thin(*node, drift, heights, tracks);
    } else {
      freeze_oldest_node(drift, heights, tracks);
    }
  }
  return true;
}

}  // namespace geoloc
