// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace geoloc::io {

/// Writes the file beside its place and renames it: readers see the old content or the new, never half.
/// Throws std::runtime_error naming the file and the system's reason.
inline void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  std::filesystem::path beside = file;
  beside += ".partial-" + std::to_string(::getpid());
  const auto fail = [&](int error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw std::runtime_error(file.string() +
                             ": cannot be written: " + std::generic_category().message(error));
  };
  errno = 0;
  std::ofstream output(beside, std::ios::binary);
  output.write(content.data(), static_cast<std::streamsize>(content.size()));
  output.close();
  if (!output) fail(errno != 0 ? errno : EIO);
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) fail(error.value());
}

}  // namespace geoloc::io
