// SPDX-License-Identifier: Apache-2.0
#include "tracking/head_bound.hpp"

namespace geoloc {
namespace {

void freeze_oldest_spell(DriftTimeline& drift, TrackTable& tracks, SettledSums& settled) {
  for (RestingObject& track : tracks) track.landmark->freeze_spell(drift.sway().begin(), drift);
  settled.freeze_oldest_spell(drift);
  drift.sway().freeze_oldest();
}

void freeze_oldest_node(DriftTimeline& drift, HeightLog& heights, TrackTable& tracks, SettledSums& settled) {
  for (RestingObject& track : tracks) track.landmark->freeze(drift.begin(), drift);
  settled.freeze_oldest_node(drift);
  heights.freeze_oldest(drift);
  drift.freeze_oldest();
}

/// Spells lie between the nodes that they were made with.
void thin(const ThinnedNode& node, DriftTimeline& drift, HeightLog& heights, TrackTable& tracks,
          SettledSums& settled) {
  const SwayTimeline& sway = drift.sway();
  while (sway.size() > 1 && sway.spell(sway.begin()).node <= node.number)
    freeze_oldest_spell(drift, tracks, settled);
  for (RestingObject& track : tracks) track.landmark->thin(node, drift);
  settled.thin(node);
  heights.thin(node);
  drift.thin(node);
}

}  // namespace

bool bound_head(const DriftConfig& config, DriftTimeline& drift, HeightLog& heights, TrackTable& tracks,
                SettledSums& settled) {
  while (drift.sway().is_full()) freeze_oldest_spell(drift, tracks, settled);
  if (drift.size() <= config.max_nodes) return false;
  while (drift.size() > config.max_nodes) {
    if (const auto node = drift.next_to_thin()) {
      thin(*node, drift, heights, tracks, settled);
    } else {
      freeze_oldest_node(drift, heights, tracks, settled);
    }
  }
  return true;
}

}  // namespace geoloc
