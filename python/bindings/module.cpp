// SPDX-License-Identifier: Apache-2.0
// What the Python package geoloc is made on: arrays, JSON and bytes in, rows out. python/geoloc has the API.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "geoloc/geoloc.hpp"
#include "geoloc/geometry/angles.hpp"
#include "rows.hpp"
#include "values.hpp"

namespace geoloc::python {

std::optional<Fields> calibration_of(const std::optional<Calibration>& learnt) {
  if (!learnt) return std::nullopt;
  using Index = CalibrationIndex;
  const Eigen::Vector3d boresight_deg = learnt->boresight_rad() / kRadPerDeg;
  const auto sigma_deg = [&](int axis) { return learnt->sigma(Index::kBoresight + axis) / kRadPerDeg; };
  Fields fields;
  fields["boresight_deg"] = nb::make_tuple(boresight_deg.x(), boresight_deg.y(), boresight_deg.z());
  fields["sigma_boresight_deg"] = nb::make_tuple(sigma_deg(0), sigma_deg(1), sigma_deg(2));
  fields["latency_s"] = learnt->latency_s();
  fields["sigma_latency_s"] = learnt->sigma(Index::kLatency);
  fields["height_m"] = learnt->height_m();
  fields["sigma_height_m"] = learnt->sigma(Index::kHeight);
  fields["focal_percent"] = learnt->focal_percent();
  fields["sigma_focal_percent"] = learnt->sigma_focal_percent();
  fields["position_lag_s"] = learnt->position_lag_s();
  fields["sigma_position_lag_s"] = learnt->sigma(Index::kPositionLag);
  fields["offset_m"] = nb::make_tuple(learnt->offset_m().x(), learnt->offset_m().y());
  fields["sigma_offset_m"] = nb::make_tuple(learnt->sigma(Index::kOffset), learnt->sigma(Index::kOffset + 1));
  return fields;
}

Counts counts_of(const Geolocator& geolocator) {
  const Geolocator::Counters& frames = geolocator.counters();
  const StateProvider::Counters state = geolocator.state().counters();
  const TrackCounters& tracks = geolocator.track_counters();
  Counts counts;
  counts["frames"] = frames.frames;
  counts["frames_located"] = frames.frames_located;
  counts["frames_waiting"] = geolocator.frames_waiting();
  counts["detections"] = frames.detections;
  counts["detections_dropped"] = frames.detections_dropped;
  counts["detections_at_edge"] = frames.detections_at_edge;
  counts["attitudes"] = state.attitudes;
  counts["positions"] = state.positions;
  counts["gimbals"] = state.gimbals;
  counts["focal_lengths"] = state.focal_lengths;
  counts["ranges"] = frames.ranges;
  counts["duplicates"] = state.duplicates;
  counts["stale"] = state.stale;
  counts["invalid"] = state.invalid;
  counts["out_of_range"] = state.out_of_range;
  counts["too_far"] = state.too_far;
  counts["reboots"] = state.reboots;
  counts["tracks_created"] = tracks.created;
  counts["tracks_removed"] = tracks.removed;
  counts["tracks_merged"] = tracks.merged;
  counts["tracks_refused"] = tracks.refused;
  return counts;
}

}  // namespace geoloc::python

NB_MODULE(_core, module) {
  using namespace geoloc::python;
  module.def("version", [] { return GEOLOC_VERSION; });
  module.def("row_sizes", [] {
    return std::array<std::size_t, 6>{sizeof(ObjectRow),        sizeof(FixRow),
                                      sizeof(RawFixRow),        sizeof(TrajectoryRow),
                                      sizeof(SummaryObjectRow), sizeof(FusedObjectRow)};
  });
  module.def(
      "explain",
      [](int fate) {
        if (fate < 0 || fate >= static_cast<int>(geoloc::kFrameFates))
          throw std::invalid_argument("no frame's fate");
        return geoloc::explain(static_cast<geoloc::FrameFate>(fate));
      },
      nb::arg("fate"));
  bind_fleet(module);
  bind_geolocator(module);
  bind_recordings(module);
}
