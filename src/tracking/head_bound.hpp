// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/drift.hpp"
#include "calibration/height_log.hpp"
#include "calibration/settled_sums.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// Leaves no more nodes and spells to be estimated than `config` allows, however long the flight: the older
/// nodes are, the fewer stand for them. True where a node was left out, so that earlier looks cannot be
/// linearised anew any more.
bool bound_head(const DriftConfig& config, DriftTimeline& drift, HeightLog& heights, TrackTable& tracks,
                SettledSums& settled);

}  // namespace geoloc
