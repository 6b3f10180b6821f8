// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"

// A recording is a folder: telemetry.tlog, frames.jsonl, camera.json, and optionally config.json,
// truth.geojson (docs/formats.md). These are the values that its reader and its writer share.
namespace geoloc::io {

/// One line of frames.jsonl.
struct RecordedFrame {
  HostTime captured_at;  ///< best estimate of the capture time, on the clock of the tlog's stamps
  std::vector<Detection> detections;
  /// Number of records of telemetry.tlog that had been read when the frame was processed. With it a replay
  /// repeats the live run exactly; without it (recordings of other tools) the replay reads ahead until the
  /// state is known.
  std::optional<std::uint64_t> telemetry_records;
  double time_sigma_s = 0.0;      ///< 1-sigma of captured_at; 0: not stated
  std::string time_quality = {};  ///< how captured_at was obtained (docs/video.md); empty: not stated
  std::optional<CameraMount> mount = std::nullopt;         ///< of a camera that moves; nullopt: camera.json's
  std::optional<Eigen::Vector2d> focal_px = std::nullopt;  ///< of one that zooms; nullopt: camera.json's
};

/// As GeoJSON has them.
using TargetId = std::variant<int, std::string>;

inline std::string to_text(const TargetId& id) {
  const auto* number = std::get_if<int>(&id);
  return number != nullptr ? std::to_string(*number) : std::get<std::string>(id);
}

/// A point of truth.geojson.
struct TrueTarget {
  TargetId id = 0;
  int class_id = 0;
  Geodetic position;
  std::optional<double> height_above_home_m;
};

}  // namespace geoloc::io
