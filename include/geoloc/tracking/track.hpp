// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/tracking/class_votes.hpp"

namespace geoloc {

/// Horizontal position with its uncertainty: rows and columns are east, north.
struct Gaussian2 {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();            ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [m^2]
};

/// Height of an object, above where the vehicle's home was at the flight's start.
struct HeightEstimate {
  double above_home_m = 0.0;
  double sigma_m = 0.0;
};

enum class TrackStatus { kTentative, kConfirmed };

/// One object on the ground, as far as it is known.
struct Track {
  std::uint64_t id = 0;  ///< unique for the life of the tracker, never reused
  TrackStatus status = TrackStatus::kTentative;
  Gaussian2 position_in_enu;
  std::optional<HeightEstimate> height;      ///< where the method estimates one
  std::optional<Gaussian2> velocity_in_enu;  ///< [m/s]; of objects of moving classes
  int hits = 0;                              ///< detections that made it
  int penalty = 0;  ///< frames in which it should have been seen and was not, less those in which it was
  double confidence_sum = 0.0;
  std::optional<double> existence;  ///< probability
  ClassVotes class_votes;
  HostTime first_seen;
  HostTime last_seen;

  int class_id() const { return class_votes.winner(); }
  /// That it exists, where the method estimates it; otherwise the mean confidence of its detections.
  double confidence() const {
    if (existence) return *existence;
    return hits > 0 ? confidence_sum / hits : 0.0;
  }
};

/// A detection turned out to show the object: what it tells of it besides its position.
inline void record_detection(Track& track, const Detection& detection, HostTime captured_at) {
  ++track.hits;
  track.confidence_sum += detection.confidence;
  track.class_votes.add(detection.class_id, detection.confidence);
  track.last_seen = captured_at;
}

/// Two tracks turned out to be one object: what `gone` knew besides its position goes to `kept`.
inline void merge_records(Track& kept, const Track& gone) {
  kept.hits += gone.hits;
  kept.confidence_sum += gone.confidence_sum;
  kept.class_votes.add(gone.class_votes);
  kept.penalty = std::min(kept.penalty, gone.penalty);
  kept.first_seen = std::min(kept.first_seen, gone.first_seen);
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
  if (gone.status == TrackStatus::kConfirmed) kept.status = TrackStatus::kConfirmed;
}

/// What became of tracks since the start, and of a rangefinder's readings.
struct TrackCounters {
  std::uint64_t created = 0;
  std::uint64_t removed = 0;
  std::uint64_t merged = 0;
  std::uint64_t refused = 0;  ///< for want of room
  std::uint64_t ranges_used = 0;
  std::uint64_t ranges_refused = 0;   ///< they disagree with what looks tell of the height
  std::uint64_t latency_changes = 0;  ///< frames were found to be stamped with another latency
  std::uint64_t frames_turned = 0;    ///< whose looks show that the vehicle's yaw was 180 deg off
};

}  // namespace geoloc
