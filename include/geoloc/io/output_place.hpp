// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <system_error>

namespace geoloc::io {

/// Where an output's name leads.
struct OutputPlace {
  std::filesystem::path path;  ///< with links followed
  /// A file, or none yet: it is written beside and takes the place when it is whole, which the system denies
  /// where a folder is. Anything else (device, FIFO, socket) is written to, and never replaced.
  bool is_file = false;
};

/// Follows a name's links, up to one that no name can stand for, as that of /dev/stdout to a pipe.
inline OutputPlace output_place(std::filesystem::path name) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as many as the system itself follows
  std::error_code ignored;
  for (int link = 0; link < kMostLinks && fs::is_symlink(name, ignored); ++link) {
    const fs::path next = name.parent_path() / fs::read_symlink(name, ignored);
    if (fs::exists(name, ignored) && !fs::equivalent(name, next, ignored)) return {name, false};
    name = next;
  }
  const auto type = fs::status(name, ignored).type();
  const bool is_none = type == fs::file_type::not_found;
  return {name, is_none || type == fs::file_type::regular || type == fs::file_type::directory};
}

}  // namespace geoloc::io
