// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/tracking/known_points.hpp"

namespace geoloc::io {

/// GeoJSON Points (WGS84) of surveyed objects; properties, all optional: `id` (text or number), `class_id`,
/// `sigma_m` (0.05). Throws std::runtime_error with file, feature and reason.
std::vector<KnownPoint> read_known_points(const std::filesystem::path& file);

/// The same from the file's text; `name` stands for the file in messages.
std::vector<KnownPoint> parse_known_points(const std::string& text, const std::string& name);

}  // namespace geoloc::io
