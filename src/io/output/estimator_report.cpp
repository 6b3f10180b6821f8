// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/estimator_report.hpp"

#include <numeric>

#include "geoloc/state/state_provider.hpp"

namespace geoloc::io {
namespace {

RunCounters counters_of(const Geolocator& geolocator) {
  const auto& frames = geolocator.counters();
  const auto telemetry = geolocator.state().counters();
  const auto& tracks = geolocator.track_counters();
  RunCounters counters;
  counters.frames = frames.frames;
  counters.frames_located = frames.frames_located;
  counters.frames_unusable = frames.frames_unusable;
  counters.detections = frames.detections;
  counters.detections_without_fix =
      std::accumulate(frames.no_fix.begin(), frames.no_fix.end(), std::uint64_t{0});
  counters.attitudes = telemetry.attitudes;
  counters.positions = telemetry.positions;
  counters.reboots = telemetry.reboots;
  counters.home_moves = telemetry.home_moves;
  counters.position_steps = telemetry.position_steps;
  counters.height_steps = telemetry.height_steps;
  counters.yaw_steps = telemetry.yaw_steps;
  counters.clock_steps = telemetry.clock_steps;
  counters.latency_changes = tracks.latency_changes;
  counters.frames_turned = tracks.frames_turned;
  counters.tracks_created = tracks.created;
  counters.tracks_removed = tracks.removed;
  counters.tracks_merged = tracks.merged;
  counters.ranges_used = tracks.ranges_used;
  counters.ranges_refused = tracks.ranges_refused;
  counters.detections_at_edge = frames.detections_at_edge;
  counters.detections_above_horizon = frames.no_fix[static_cast<std::size_t>(NoFix::kAboveHorizon)];
  return counters;
}

}  // namespace

EstimatorReport report_estimator(const Geolocator& geolocator) {
  EstimatorReport report;
  report.calibration = geolocator.calibration();
  report.counters = counters_of(geolocator);
  const auto& entries = geolocator.known_points();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    report.known_points.push_back(
        {geolocator.config().known_points[i].name, entries[i].status, entries[i].track_id});
  }
  return report;
}

}  // namespace geoloc::io
