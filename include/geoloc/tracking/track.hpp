// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geoloc/geometry/time.hpp"
#include "geoloc/tracking/class_votes.hpp"
#include "geoloc/tracking/gaussian.hpp"

namespace geoloc {

enum class TrackStatus { kTentative, kConfirmed };

/// One object on the ground, as far as it is known.
struct Track {
  std::uint64_t id = 0;  ///< unique for the life of the tracker, never reused
  TrackStatus status = TrackStatus::kTentative;
  Gaussian2 position_in_enu;
  int hits = 0;     ///< detections that made it
  int penalty = 0;  ///< frames in which it should have been seen and was not, less those in which it was
  double confidence_sum = 0.0;
  ClassVotes class_votes;
  HostTime first_seen;
  HostTime last_seen;

  int class_id() const { return class_votes.winner(); }
  /// Mean confidence of its detections.
  double confidence() const { return hits > 0 ? confidence_sum / hits : 0.0; }
};

}  // namespace geoloc
