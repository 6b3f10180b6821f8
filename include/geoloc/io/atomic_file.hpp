// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "geoloc/io/partial_file.hpp"

namespace geoloc::io {

/// Whether a name is that of a file or is unused, rather than that of a device or a pipe.
inline bool is_file_or_none(const std::filesystem::path& name) {
  std::error_code ignored;
  const auto type = std::filesystem::status(name, ignored).type();
  return type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular;
}

/// Writes the file under a temporary name beside its own and renames it: readers see either the old content
/// or the new. Devices and pipes are written to directly. Throws std::runtime_error naming the file and the
/// system's reason.
inline void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  std::optional<PartialFile> beside;
  if (is_file_or_none(file)) beside.emplace(file);
  errno = 0;
  std::ofstream output(beside ? beside->name() : file, std::ios::binary);
  output.write(content.data(), static_cast<std::streamsize>(content.size()));
  output.close();
  if (!output) fail_to_write(file, errno);
  if (beside) beside->commit();
}

}  // namespace geoloc::io
