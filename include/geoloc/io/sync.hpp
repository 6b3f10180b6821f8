// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// Makes what was written to a descriptor survive a power cut. Returns the system's error, or 0, which is
/// also the answer of devices and file systems that know no such promise.
inline int sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno == EINVAL || errno == ENOTSUP || errno == ENOSYS || errno == EROFS) return 0;
    if (errno != EINTR) return errno;
  }
  return 0;
}

/// The same for a file by its name, or for a folder, whose content is the names in it. Throws as
/// fail_to_write() does.
inline void sync(const std::filesystem::path& file_or_folder) {
  const int descriptor = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(file_or_folder, errno);
  const int error = sync(descriptor);
  ::close(descriptor);
  if (error != 0) fail_to_write(file_or_folder, error);
}

/// Makes a new name survive a power cut. Throws as fail_to_write() does.
inline void sync_name(const std::filesystem::path& name) {
  const std::filesystem::path folder = name.parent_path();
  sync(folder.empty() ? std::filesystem::path(".") : folder);
}

}  // namespace geoloc::io
