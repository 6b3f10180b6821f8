// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Names come from models and other people's files, and may contain anything.
namespace geoloc::io {

/// The text as valid UTF-8 that every format and terminal accepts: invalid bytes become U+FFFD, and control
/// characters (C0, DEL, C1) and those that XML excludes are left out. A text of more than `max_characters` is
/// cut and ends in an ellipsis.
std::string clean_text(std::string_view text, std::size_t max_characters = std::string_view::npos);

/// Printable ASCII of at most `max_size`; anything else becomes a question mark.
std::string ascii_text(std::string_view text, std::size_t max_size);

}  // namespace geoloc::io
