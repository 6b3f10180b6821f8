// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

namespace geoloc::io {

/// How many bytes a number of a type takes, which is called as Python's struct calls it: b B h H i I q Q f d.
/// 0 for all else.
std::size_t plain_size(char type);

/// The number that lies there, little-endian. nullopt for a type that plain_size() does not know.
std::optional<double> plain_number(char type, const char* bytes);

}  // namespace geoloc::io
