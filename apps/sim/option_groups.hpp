// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace geoloc::sim {

enum class Mode { kLive, kRecord, kImages };

// Options by what they are about, and by the modes that they have an effect in.
inline constexpr const char* kFlightGroup = "Flight (recordings and live)";
inline constexpr const char* kCameraGroup = "Camera (recordings and live)";
inline constexpr const char* kHiddenGroup = "Errors the estimator is not told (recordings and live)";
inline constexpr const char* kHiddenInRecordingsGroup = "Errors the estimator is not told (recordings)";
inline constexpr const char* kRecordGroup = "Recording without video";
inline constexpr const char* kLiveGroup = "Live (without --record and --images)";
inline constexpr const char* kLinkGroup = "Faults of the MAVLink link (live)";
inline constexpr const char* kImagesGroup = "Labelled pictures";

/// What to tell a user who gave options that have no effect in the mode; empty where there are none.
std::string options_without_effect(const CLI::App& program, Mode mode);

}  // namespace geoloc::sim
