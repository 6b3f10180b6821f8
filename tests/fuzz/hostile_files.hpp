// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/require.hpp"
#include "geoloc/io/config/calibration_file.hpp"
#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/config/known_points_file.hpp"
#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/camera_file.hpp"
#include "geoloc/io/recording/notes_file.hpp"
#include "geoloc/io/recording/recording_reader.hpp"
#include "geoloc/io/recording/recording_writer.hpp"

// Every reader of external files, given any bytes: it may reject them with a std::exception, but what it
// accepts must be usable. Violations abort. Shared by the fuzz programs and by the test that damages good
// files.
namespace geoloc::io::hostile {

inline bool is_usable(const Detection& detection) {
  const Box& box = detection.box;
  return std::isfinite(box.x) && std::isfinite(box.y) && box.width > 0.0 && box.height > 0.0 &&
         detection.confidence >= 0.0 && detection.confidence <= 1.0 && detection.class_id >= 0 &&
         (detection.sigma_px == 0.0 || is_sigma_px(detection.sigma_px));
}

inline void read_any_frames(const std::string& text, BadLines bad_lines) {
  std::istringstream input(text);
  SkippedLines skipped;
  HostTime previous{};
  for (const RecordedFrame& frame : read_frames(input, "any", bad_lines, skipped)) {
    require(frame.captured_at >= previous);
    previous = frame.captured_at;
    for (const Detection& detection : frame.detections) require(is_usable(detection));
    if (frame.mount) require(CameraConfig{{}, *frame.mount}.problems().empty());
    if (frame.focal_px) require(frame.focal_px->allFinite() && frame.focal_px->minCoeff() > 0.0);
  }
}

/// frames.jsonl.
inline void read_any_frames(const std::string& text) {
  read_any_frames(text, BadLines::kSkip);  // refuses nothing
  try {
    read_any_frames(text, BadLines::kRefuse);
  } catch (const std::exception&) {
  }
}

/// telemetry.tlog. Every byte belongs to a record or is counted.
inline void read_any_tlog(const std::string& text) {
  const Tlog log(std::vector<std::uint8_t>(text.begin(), text.end()));
  std::size_t framed = 0;
  for (const TlogRecord& record : log.records()) {
    require(record.frame[0] == 0xFD || record.frame[0] == 0xFE);
    const volatile std::uint8_t last = record.frame[record.size - 1];  // a sanitizer would detect a bad read
    static_cast<void>(last);
    framed += 8 + record.size;
  }
  require(framed + log.skipped_bytes() == text.size());
}

/// A calibration, as YAML and as JSON.
inline void read_any_camera(const std::string& text) {
  try {
    require(camera_from_yaml(text, "any", {}).problems().empty());
  } catch (const std::runtime_error&) {
  }
  CameraConfig camera;
  std::vector<std::string> problems;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_discarded()) camera_from_json(json, "", false, camera, problems);
}

/// --config: what is accepted can be printed, and what is printed is accepted.
inline void read_any_config(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return;
  if (json.is_object() && json.contains("camera") && json["camera"].is_string())
    return;  // it would open that file
  GeolocatorConfig config;
  std::vector<std::string> problems;
  geolocator_from_json(json, config, problems);
  if (!problems.empty()) return;
  GeolocatorConfig again;
  geolocator_from_json(nlohmann::json(geolocator_to_json(config)), again, problems);
  require(problems.empty());
}

/// truth.geojson.
inline void read_any_truth(const std::string& text) {
  try {
    const auto targets = parse_truth(text, "any");
    const auto again = parse_truth(truth_to_geojson(targets), "any");
    require(again.size() == targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i)
      require(is_valid(targets[i].position) && again[i].id == targets[i].id);
  } catch (const std::runtime_error&) {
  }
}

/// notes.jsonl: what is read can be written, and is read again the same.
inline void read_any_notes(const std::string& text) {
  std::istringstream input(text);
  std::size_t skipped = 0;
  for (const NotedObject& noted : read_notes(input, skipped)) {
    require(is_valid(noted.position));
    std::istringstream line(note_to_line(noted));
    std::size_t lost = 0;
    const auto again = read_notes(line, lost);
    require(lost == 0 && again.size() == 1 && again[0].object_id == noted.object_id &&
            again[0].at == noted.at);
  }
}

/// --known-points and --calibration.
inline void read_any_priors(const std::string& text) {
  try {
    for (const KnownPoint& point : parse_known_points(text, "any")) require(point.problems().empty());
  } catch (const std::runtime_error&) {
  }
  try {
    require(parse_calibration(text, "any", {}, 0.7).problems().empty());
  } catch (const std::runtime_error&) {
  }
}

}  // namespace geoloc::io::hostile
