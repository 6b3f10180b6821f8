// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/recording/recording_reader.hpp"

namespace geoloc::python {

/// A recording as its files' contents, which Python's Recording takes apart and puts together.
struct Files {
  std::string camera_json, frames_jsonl;
  std::vector<std::uint8_t> telemetry;
  std::optional<std::string> config_json, truth_geojson;
  std::vector<std::string> class_names;
  std::uint64_t frames_damaged = 0;
};

Files files_of(const io::Recording& recording);

/// Throws std::runtime_error that names the faults.
io::Recording recording_of(const Files& files);

/// To a new folder. Throws std::runtime_error where it cannot be written.
void write(const io::Recording& recording, const std::filesystem::path& folder);

}  // namespace geoloc::python
