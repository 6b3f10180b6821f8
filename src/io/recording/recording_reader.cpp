// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/recording_reader.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <istream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/camera_file.hpp"
#include "geoloc/io/json/detection_fields.hpp"
#include "geoloc/io/recording/notes_file.hpp"
#include "geoloc/io/recording/object_pictures.hpp"
#include "geoloc/io/recording/recording_files.hpp"
#include "geoloc/io/text_file.hpp"
#include "io/json/plain_values.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostNamed = 10;                           // bad lines
constexpr std::int64_t kLatestStamp_us = 7'258'118'400'000'000;  // year 2200

double parse_time_sigma_s(const json& value) {
  const double sigma_s = finite_number(value, "time_sigma_s");
  if (!(sigma_s > 0.0 && sigma_s <= kLargestTimeSigma_s))
    throw std::invalid_argument("time_sigma_s must lie in (0, 60]; leave it out where it is not known");
  return sigma_s;
}

std::string parse_time_quality(const json& value) {
  if (!value.is_string()) throw std::invalid_argument("time_quality must be a word");
  return value.get<std::string>();
}

CameraMount parse_mount(const json& value) {
  CameraMount mount;
  std::vector<std::string> problems;
  mount_from_json(value, "mount", mount, problems);
  if (problems.empty()) problems = CameraConfig{{}, mount}.problems();
  if (!problems.empty()) throw std::invalid_argument(problems.front());
  return mount;
}

/// Beyond these no image of any size has one; whether this camera's may is asked by refuse_focal_lengths().
Eigen::Vector2d parse_focal_length(const json& value) {
  constexpr double kShortest_px = 0.01, kLongest_px = 1e9;
  if (!value.is_array() || value.size() != 2)
    throw std::invalid_argument("focal_px must be two numbers, fx and fy");
  const Eigen::Vector2d focal_px(finite_number(value[0], "focal_px"), finite_number(value[1], "focal_px"));
  if (!(focal_px.minCoeff() >= kShortest_px && focal_px.maxCoeff() <= kLongest_px))
    throw std::invalid_argument("focal_px must be in pixels of the full image, above 0");
  return focal_px;
}

RecordedFrame parse_frame(const std::string& line) {
  const json value = json::parse(line, nullptr, false);
  if (value.is_discarded() || !value.is_object()) throw std::invalid_argument("not a JSON object");
  const json& time = member(value, "time_us");
  if (!time.is_number_integer() || time.get<std::int64_t>() < 0 ||
      time.get<std::int64_t>() > kLatestStamp_us) {
    throw std::invalid_argument("time_us must be whole microseconds since 1970");
  }
  RecordedFrame frame;
  frame.captured_at = HostTime{std::chrono::microseconds{time.get<std::int64_t>()}};
  if (value.contains("time_sigma_s")) frame.time_sigma_s = parse_time_sigma_s(value["time_sigma_s"]);
  if (value.contains("time_quality")) frame.time_quality = parse_time_quality(value["time_quality"]);
  if (value.contains("mount")) frame.mount = parse_mount(value["mount"]);
  if (value.contains("focal_px")) frame.focal_px = parse_focal_length(value["focal_px"]);
  const json& detections = member(value, "detections");
  if (!detections.is_array()) throw std::invalid_argument("detections must be a list");
  for (const json& detection : detections) frame.detections.push_back(detection_from_json(detection));
  if (const auto records = value.find("telemetry_records"); records != value.end()) {
    if (!records->is_number_unsigned())
      throw std::invalid_argument("telemetry_records must be a whole number from 0");
    frame.telemetry_records = records->get<std::uint64_t>();
  }
  return frame;
}

TargetId parse_id(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) throw std::invalid_argument("id must be a text or a whole number from 0");
  return whole_number(value, "id", 1e9);
}

TrueTarget parse_target(const json& feature, int position) {
  const json& coordinates = member(member(feature, "geometry"), "coordinates");
  if (!coordinates.is_array() || coordinates.size() < 2) {
    throw std::invalid_argument("coordinates must be [lon, lat]");
  }
  TrueTarget target;
  target.id = position;
  target.position.longitude_deg = finite_number(coordinates[0], "longitude");
  target.position.latitude_deg = finite_number(coordinates[1], "latitude");
  if (!is_valid(target.position)) throw std::invalid_argument("not a place on Earth (lon, lat order?)");
  if (const auto properties = feature.find("properties");
      properties != feature.end() && properties->is_object()) {
    if (properties->contains("id")) target.id = parse_id((*properties)["id"]);
    if (properties->contains("class_id")) {
      target.class_id = whole_number((*properties)["class_id"], "class_id", 1e6);
    }
    if (properties->contains("height_above_home_m"))
      target.height_above_home_m = finite_number((*properties)["height_above_home_m"], "height_above_home_m");
  }
  return target;
}

std::vector<std::string> read_class_names(const fs::path& file) {
  const json names = json::parse(read_text_file(file), nullptr, false);
  const bool is_list_of_texts =
      names.is_array() &&
      std::all_of(names.begin(), names.end(), [](const json& name) { return name.is_string(); });
  if (!is_list_of_texts) throw std::runtime_error(file.string() + ": not a JSON list of names");
  return names.get<std::vector<std::string>>();
}

std::uint64_t read_damaged(const fs::path& file) {
  const json counts = json::parse(read_text_file(file), nullptr, false);
  if (!counts.is_object() || !counts.contains("frames_damaged") ||
      !counts["frames_damaged"].is_number_unsigned())
    throw std::runtime_error(file.string() + ": frames_damaged must be a whole number from 0");
  return counts["frames_damaged"].get<std::uint64_t>();
}

fs::path require_file(const fs::path& file) {
  if (!fs::is_regular_file(file)) {
    throw std::runtime_error(file.string() +
                             ": missing; a recording holds telemetry.tlog, frames.jsonl, camera.json");
  }
  return file;
}

/// What a power cut leaves of a file's end: a line without an end, or zeros that had not been written over.
bool is_cut_off(const std::string& line, const std::istream& input) {
  return input.eof() || line.find('\0') != std::string::npos;
}

/// Frames whose focal length no camera with that image has; skipped where bad lines are.
void refuse_focal_lengths(const CameraIntrinsics& camera, const std::string& name, BadLines bad_lines,
                          Recording& recording) {
  const auto is_bad = [&](const RecordedFrame& frame) {
    return frame.focal_px && !is_focal_length(*frame.focal_px, camera);
  };
  auto& frames = recording.frames;
  const auto first = std::find_if(frames.begin(), frames.end(), is_bad);
  if (first == frames.end()) return;
  const auto time_us =
      std::chrono::floor<std::chrono::microseconds>(first->captured_at.time_since_epoch()).count();
  const std::string fault = name + ": the frame of time_us " + std::to_string(time_us) +
                            ": focal_px must be 0.01 to 10000 times the image's size that way";
  if (bad_lines == BadLines::kRefuse) throw std::runtime_error(fault + " (--keep-going skips bad lines)");
  const auto kept_end = std::remove_if(first, frames.end(), is_bad);
  recording.skipped.count += static_cast<std::size_t>(frames.end() - kept_end);
  if (recording.skipped.named.size() < kMostNamed) recording.skipped.named.push_back(fault);
  frames.erase(kept_end, frames.end());
}

}  // namespace

std::vector<RecordedFrame> read_frames(std::istream& input, const std::string& name, BadLines bad_lines,
                                       SkippedLines& skipped) {
  std::vector<RecordedFrame> frames;
  std::size_t refused = 0;
  std::string refusals;
  std::string line;
  for (std::size_t number = 1; std::getline(input, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      RecordedFrame frame = parse_frame(line);
      if (!frames.empty() && frame.captured_at < frames.back().captured_at) {
        throw std::invalid_argument("time_us runs backwards");
      }
      frames.push_back(std::move(frame));
    } catch (const std::exception& error) {
      const std::string fault = name + ":" + std::to_string(number) + ": " + error.what();
      if (bad_lines == BadLines::kRefuse && !is_cut_off(line, input)) {
        ++refused;
        if (refused <= kMostNamed) refusals += (refusals.empty() ? "" : "\n") + fault;
        continue;
      }
      ++skipped.count;
      if (skipped.named.size() < kMostNamed) skipped.named.push_back(fault);
    }
  }
  if (refused == 0) return frames;
  if (refused > kMostNamed) refusals += "\nand " + std::to_string(refused - kMostNamed) + " more bad lines";
  throw std::runtime_error(refusals + " (--keep-going skips bad lines)");
}

std::vector<TrueTarget> parse_truth(const std::string& text, const std::string& name) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded() || !document.is_object() || !document.contains("features") ||
      !document["features"].is_array()) {
    throw std::runtime_error(name + ": not a GeoJSON FeatureCollection");
  }
  std::vector<TrueTarget> targets;
  for (const json& feature : document["features"]) {
    try {
      targets.push_back(parse_target(feature, static_cast<int>(targets.size())));
    } catch (const std::exception& error) {
      throw std::runtime_error(name + ": feature " + std::to_string(targets.size()) + ": " + error.what());
    }
  }
  return targets;
}

std::vector<TrueTarget> read_truth(const fs::path& file) {
  return parse_truth(read_text_file(file), file.string());
}

Recording read_recording(const fs::path& folder, BadLines bad_lines) {
  if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + ": no such recording folder");
  Recording recording;
  recording.camera = read_camera_file(require_file(folder / kCameraFile));
  const fs::path frames_file = require_file(folder / kFramesFile);
  std::ifstream frames(frames_file, std::ios::binary);
  if (!frames) throw std::runtime_error(frames_file.string() + ": cannot be opened");
  recording.frames = read_frames(frames, frames_file.string(), bad_lines, recording.skipped);
  refuse_focal_lengths(recording.camera.intrinsics, frames_file.string(), bad_lines, recording);
  recording.telemetry = read_tlog(require_file(folder / kTelemetryFile));
  if (fs::exists(folder / kConfigFile)) recording.config_json = read_text_file(folder / kConfigFile);
  if (fs::exists(folder / kClassNamesFile))
    recording.class_names = read_class_names(folder / kClassNamesFile);
  if (fs::exists(folder / kCountsFile)) recording.frames_damaged = read_damaged(folder / kCountsFile);
  if (fs::exists(folder / kTruthFile)) recording.truth = read_truth(folder / kTruthFile);
  std::ifstream notes(folder / kNotesFile, std::ios::binary);  // most recordings have none
  recording.notes = read_notes(notes, recording.skipped.count);
  recording.pictures = read_object_pictures(folder);
  return recording;
}

}  // namespace geoloc::io
