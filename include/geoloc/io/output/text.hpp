// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Names come from models and files of others, and may hold anything.
namespace geoloc::io {

/// The text as valid UTF-8 that every format and terminal takes: bytes that are none become U+FFFD, control
/// characters (C0, DEL, C1) and what XML excludes are left out. More than `max_characters` end in an
/// ellipsis.
std::string clean_text(std::string_view text, std::size_t max_characters = std::string_view::npos);

/// Printable ASCII of at most `max_size`; anything else becomes a question mark.
std::string ascii_text(std::string_view text, std::size_t max_size);

}  // namespace geoloc::io
