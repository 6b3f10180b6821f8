// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace geoloc::io {

/// The objects' pictures of a recording, JPEGs by the objects' ids. What is no JPEG, or larger than any that
/// geoloc writes, is left out, and so is what exceeds 2000 pictures.
std::map<std::uint64_t, std::string> read_object_pictures(const std::filesystem::path& folder);

}  // namespace geoloc::io
