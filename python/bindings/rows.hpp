// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/geoloc.hpp"
#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/output/run_record.hpp"

// Rows of NumPy's structured arrays, whose dtypes python/geoloc/_rows.py has: the same names in the same
// order. What is not known is NaN, and an object or a time that is none is -1.
namespace geoloc::python {

struct ObjectRow {
  std::uint64_t id;
  std::int64_t class_id, hits;
  double confidence;
  double latitude_deg, longitude_deg, height_above_home_m;
  double sigma_major_m, sigma_minor_m, sigma_azimuth_deg, sigma_height_m;
  double position_in_enu_m[2], covariance_m2[4];
  double velocity_in_enu_mps[2], velocity_covariance_m2ps2[4];
  std::int64_t first_seen_ns, last_seen_ns;
  bool is_confirmed;
  std::uint8_t unused[7];  // so that equal rows are equal bytes
};

/// A detection of the frame located last.
struct FixRow {
  double box_px[4], confidence;
  std::int64_t class_id;
  double latitude_deg, longitude_deg, position_in_enu_m[2];
  double ground_from_pixel_mppx[4], range_m;
};

/// A detection of a run.
struct RawFixRow {
  std::int64_t captured_at_ns;
  std::uint64_t frame;
  std::int64_t object_id;
  double box_px[4], confidence;
  std::int64_t class_id;
  double latitude_deg, longitude_deg, position_in_enu_m[2], range_m, expected_px[2];
};

struct TrajectoryRow {
  std::int64_t captured_at_ns;
  double latitude_deg, longitude_deg, position_in_enu_m[3];
};

/// An object of one flight's summary.
struct SummaryObjectRow {
  std::uint64_t id;
  std::int64_t class_id, hits;
  double confidence;
  double position_in_enu_m[3], own_covariance_m2[9];
  std::int64_t first_seen_ns, last_seen_ns;
};

/// An object of the map of many flights.
struct FusedObjectRow {
  std::uint64_t id;
  std::int64_t class_id, hits;
  double confidence;
  double latitude_deg, longitude_deg, height_above_home_m;
  double sigma_major_m, sigma_minor_m, sigma_azimuth_deg, sigma_height_m;
  double position_in_enu_m[3], covariance_m2[9];
  std::int64_t first_seen_ns, last_seen_ns;
};

ObjectRow row_of(const Track& track, const LocalFrame& frame);
FixRow row_of(const LocatedDetection& located, const LocalFrame& frame);
SummaryObjectRow row_of(const FlightSummary::Object& object);
FusedObjectRow row_of(const FusedObject& object, const LocalFrame& frame);
RawFixRow row_of(const io::RawFix& fix, const LocalFrame& frame);
TrajectoryRow row_of(const io::TrajectoryPoint& point, const LocalFrame& frame);

/// The rows of all that are wanted; none before the local frame is known, when there is nothing to be told.
template <typename Row, typename Source, typename IsWanted>
std::vector<Row> rows_of(const Source& source, const std::optional<LocalFrame>& frame,
                         const IsWanted& is_wanted) {
  std::vector<Row> rows;
  if (!frame) return rows;
  for (const auto& entry : source) {
    if (is_wanted(entry)) rows.push_back(row_of(entry, *frame));
  }
  return rows;
}

}  // namespace geoloc::python
