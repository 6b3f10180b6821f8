// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// `objects.old-3.geojson` for `objects.geojson` and 3.
inline std::filesystem::path old_name(const std::filesystem::path& file, int number) {
  std::filesystem::path name = file;
  name.replace_filename(file.stem());
  name += ".old-" + std::to_string(number);
  name += file.extension();
  return name;
}

/// Keeps a file of an earlier run under the first free name beside its own, so that a new one can take its
/// place. Returns that name; nullopt where there is nothing to keep. Throws as fail_to_write() does.
inline std::optional<std::filesystem::path> keep_beside(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::is_empty(file, error)) return std::nullopt;
  for (int number = 1;; ++number) {
    const fs::path kept = old_name(file, number);
    if (::link(file.c_str(), kept.c_str()) == 0) return kept;
    if (errno == EEXIST) continue;
    if (fs::exists(fs::symlink_status(kept, error))) continue;
    fs::rename(file, kept, error);  // a file system without links, as on memory cards
    if (error) fail_to_write(kept, error.value());
    return kept;
  }
}

}  // namespace geoloc::io
