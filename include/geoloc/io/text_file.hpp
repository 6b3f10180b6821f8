// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace geoloc::io {

/// A whole file, text or bytes. Throws std::runtime_error naming it if it cannot be read or is larger than
/// `max_bytes`.
inline std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes = 16u << 20) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault))
    throw std::runtime_error(file.string() + ": cannot be opened: it is a folder");
  errno = 0;
  std::ifstream input(file, std::ios::binary);
  if (!input)
    throw std::runtime_error(file.string() + ": cannot be opened: " + std::generic_category().message(errno));
  std::string text;
  std::vector<char> chunk(64u << 10);
  while (input.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || input.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(input.gcount()));
    if (text.size() > max_bytes)
      throw std::runtime_error(file.string() + ": larger than " + std::to_string(max_bytes) + " bytes");
  }
  if (input.bad()) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

}  // namespace geoloc::io
