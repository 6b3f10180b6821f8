// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/object_note.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/recording/tlog.hpp"

namespace geoloc::io {

enum class BadLines {
  kRefuse,  ///< throw
  kSkip     ///< skip and count
};

struct SkippedLines {
  std::size_t count = 0;
  std::vector<std::string> named;  ///< the first ten with file, line and reason
};

struct Recording {
  CameraConfig camera;
  Tlog telemetry;
  std::vector<RecordedFrame> frames;
  std::optional<std::string> config_json;
  std::vector<std::string> class_names;           ///< by class id; empty where the recording has none
  std::vector<TrueTarget> truth;                  ///< empty where the recording has none
  std::vector<NotedObject> notes;                 ///< what people said of the objects
  std::map<std::uint64_t, std::string> pictures;  ///< JPEGs of the objects by their ids
  std::uint64_t frames_damaged = 0;               ///< that were left out
  SkippedLines skipped;
};

/// Reads the whole folder. Throws std::runtime_error with file, line and reason for a missing file, bad
/// lines (the first ten of them): a number that is not finite, a box without size, times that run backwards.
/// What a crash or a power cut leaves at the end, half a line or zeros, is always skipped and counted.
Recording read_recording(const std::filesystem::path& folder, BadLines bad_lines = BadLines::kRefuse);

/// frames.jsonl alone; `name` stands for the file in messages.
std::vector<RecordedFrame> read_frames(std::istream& input, const std::string& name, BadLines bad_lines,
                                       SkippedLines& skipped);

/// GeoJSON Points, optionally with `id` (a number or a text) and `class_id`. Throws std::runtime_error with
/// file and reason.
std::vector<TrueTarget> read_truth(const std::filesystem::path& file);

/// The same from the file's text; `name` stands for the file in messages.
std::vector<TrueTarget> parse_truth(const std::string& text, const std::string& name);

}  // namespace geoloc::io
