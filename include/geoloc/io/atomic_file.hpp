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

/// Whether a name stands for a file or for nothing yet, not for a device or a pipe.
inline bool is_file_or_none(const std::filesystem::path& name) {
  std::error_code ignored;
  const auto type = std::filesystem::status(name, ignored).type();
  return type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular;
}

/// Writes the file beside its place and renames it: readers see the old content or the new, never half. A
/// device or a pipe is written to as it is. Throws std::runtime_error naming the file and the system's
/// reason.
inline void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  const bool is_file = is_file_or_none(file);
  std::filesystem::path beside = file;
  if (is_file) beside += ".partial-" + std::to_string(::getpid());
  const auto fail = [&](int error) {
    std::error_code ignored;
    if (is_file) std::filesystem::remove(beside, ignored);
    throw std::runtime_error(file.string() +
                             ": cannot be written: " + std::generic_category().message(error));
  };
  errno = 0;
  std::ofstream output(beside, std::ios::binary);
  output.write(content.data(), static_cast<std::streamsize>(content.size()));
  output.close();
  if (!output) fail(errno != 0 ? errno : EIO);
  if (!is_file) return;
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) fail(error.value());
}

}  // namespace geoloc::io
