// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "geoloc/geometry/time.hpp"
#include "geoloc/tracking/track.hpp"
#include "tracking/confidence_evidence.hpp"
#include "tracking/existence.hpp"
#include "tracking/look.hpp"
#include "tracking/neighbours.hpp"

namespace geoloc {

/// Looks that make a track worth comparing with others and with known points.
inline constexpr int kHitsToCompare = 3;

/// Ids and counts that the objects of one flight share.
struct TrackBook {
  std::uint64_t next_id = 1;
  TrackCounters counters;
};

/// What objects at rest and moving ones have in common: the life cycle.
struct TrackedObject {
  Track track;
  Existence existence{0.5};
  Neighbours neighbours;
  VehicleTime last_look{};
  ConfidenceCounts confidences;  ///< of its looks
  double size_m = 0.0;           ///< apparent, mean
  bool is_seen = false;          ///< in the present frame
  bool was_confirmed = false;    ///< at some time

  bool is_confirmed() const { return track.status == TrackStatus::kConfirmed; }
};

/// A new object that a look shows for the first time; its position is the caller's to set.
inline void begin_object(TrackedObject& object, const Look& look, double birth_probability,
                         HostTime captured_at, TrackBook& book) {
  object.existence = Existence(birth_probability);
  object.existence.weigh(look.confidence_ratio);
  object.track.id = book.next_id++;
  object.track.first_seen = captured_at;
  object.is_seen = true;
  ++book.counters.created;
}

/// The look shows the object: what it tells of it besides its position.
inline void record_look(TrackedObject& object, const Look& look, VehicleTime time, HostTime captured_at) {
  object.last_look = time;
  object.confidences.add(look.detection.confidence);
  object.size_m += (look.size_m - object.size_m) / (object.track.hits + 1);
  record_detection(object.track, look.detection, captured_at);
}

inline void confirm_if_probable(TrackedObject& object, double confirm_probability) {
  if (object.existence.probability() < confirm_probability) return;
  object.track.status = TrackStatus::kConfirmed;
  object.was_confirmed = true;
}

/// A confirmed object that exists less probably is not reported any more, until it is confirmed anew.
inline constexpr double kRetracted = 0.5;

inline void retract_if_improbable(TrackedObject& object) {
  if (object.existence.probability() < kRetracted) object.track.status = TrackStatus::kTentative;
}

/// Two turned out to be one: what `gone` knew besides its position goes to `kept`.
inline void merge_into(TrackedObject& kept, const TrackedObject& gone) {
  kept.last_look = std::max(kept.last_look, gone.last_look);
  kept.existence.merge(gone.existence);
  kept.confidences.add(gone.confidences);
  kept.neighbours.merge(gone.neighbours);
  kept.was_confirmed = kept.was_confirmed || gone.was_confirmed;
  merge_records(kept.track, gone.track);
}

}  // namespace geoloc
