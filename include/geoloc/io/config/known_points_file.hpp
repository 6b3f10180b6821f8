// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/tracking/known_points.hpp"

namespace geoloc::io {

/// GeoJSON Points (WGS84) of surveyed objects; properties, all optional: `id` (text or number), `class_id`,
/// `sigma_m` (0.05), `sigma_height_m` (0.05). A third coordinate is the height, above any level that is the
/// same for all; where it is 0 in all of them, they have none. Throws std::runtime_error with file, feature
/// and reason.
std::vector<KnownPoint> read_known_points(const std::filesystem::path& file);

/// The same from the file's text; `name` stands for the file in messages.
std::vector<KnownPoint> parse_known_points(const std::string& text, const std::string& name);

}  // namespace geoloc::io
