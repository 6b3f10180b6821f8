// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace geoloc::io {

/// 16 to 256 of A-Z a-z 0-9 - . _ ~, which stand for themselves in links, cookies and headers alike.
bool is_page_token(const std::string& text);

/// The token that a file holds, on one line. A file that is not there is made, with a random token and for
/// its owner's eyes alone. Throws std::runtime_error naming the file, the reason and the remedy; among the
/// reasons is that every user of the computer can read it.
std::string read_or_make_page_token(const std::filesystem::path& file);

}  // namespace geoloc::io
