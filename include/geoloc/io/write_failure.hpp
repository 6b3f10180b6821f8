// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace geoloc::io {

/// Throws std::runtime_error naming the file and the system's reason; an error of 0 is read as EIO.
[[noreturn]] inline void fail_to_write(const std::filesystem::path& file, int error) {
  throw std::runtime_error(
      file.string() + ": cannot be written: " + std::generic_category().message(error != 0 ? error : EIO));
}

}  // namespace geoloc::io
