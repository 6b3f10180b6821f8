// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace geoloc::io {

/// Names of a recording's files, in its folder (docs/formats.md).
inline constexpr const char* kTelemetryFile = "telemetry.tlog";
inline constexpr const char* kFramesFile = "frames.jsonl";
inline constexpr const char* kCameraFile = "camera.json";
inline constexpr const char* kConfigFile = "config.json";
inline constexpr const char* kClassNamesFile = "class_names.json";
inline constexpr const char* kCountsFile = "counts.json";
inline constexpr const char* kTruthFile = "truth.geojson";
inline constexpr const char* kNotesFile = "notes.jsonl";

/// The folder of the objects' pictures, ID.jpg.
inline constexpr const char* kPicturesFolder = "pictures";

/// All of them but the pictures; only the first three are in every recording.
inline constexpr std::array kRecordingFiles = {kTelemetryFile,  kFramesFile, kCameraFile, kConfigFile,
                                               kClassNamesFile, kCountsFile, kTruthFile,  kNotesFile};

}  // namespace geoloc::io
