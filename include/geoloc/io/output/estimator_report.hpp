// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/tracking/known_points.hpp"

namespace geoloc::io {

/// The input since the start, and what became of it.
struct RunCounters {
  std::uint64_t frames = 0;
  std::uint64_t frames_located = 0;
  std::uint64_t frames_unusable = 0;
  std::uint64_t frames_damaged = 0;  ///< on their way, and left out; not among the frames
  std::uint64_t detections = 0;      ///< in located frames
  std::uint64_t detections_without_fix = 0;
  std::uint64_t attitudes = 0;
  std::uint64_t positions = 0;
  std::uint64_t reboots = 0;
  std::uint64_t home_moves = 0;
  std::uint64_t position_steps = 0;  ///< of the vehicle's own state
  std::uint64_t height_steps = 0;
  std::uint64_t yaw_steps = 0;
  std::uint64_t clock_steps = 0;      ///< of the vehicle's clock against the host's
  std::uint64_t latency_changes = 0;  ///< frames were found to be stamped with another latency
  std::uint64_t frames_turned = 0;    ///< whose looks show that the vehicle's yaw was 180 deg off
  std::uint64_t tracks_created = 0;
  std::uint64_t tracks_removed = 0;
  std::uint64_t tracks_merged = 0;
  std::uint64_t ranges_used = 0;               ///< a rangefinder's readings
  std::uint64_t ranges_refused = 0;            ///< those that disagree with the looks
  std::uint64_t detections_at_edge = 0;        ///< not used: the image's edge may cut them
  std::uint64_t detections_above_horizon = 0;  ///< of those without a fix
};

/// What became of a known point.
struct KnownPointReport {
  std::string name;
  KnownPointStatus status = KnownPointStatus::kNotCovered;
  std::uint64_t object_id = 0;  ///< of a matched one
};

/// What the estimator says of itself, apart from the objects.
struct EstimatorReport {
  std::optional<Calibration> calibration;  ///< nullopt for a method that learns none
  RunCounters counters;
  std::vector<KnownPointReport> known_points;  ///< in the order of the configuration
};

EstimatorReport report_estimator(const Geolocator& geolocator);

}  // namespace geoloc::io
