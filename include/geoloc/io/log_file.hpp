// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

#include "geoloc/io/sync.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// A file that grows. What was appended survives a crash of the program, and after sync() a power cut, too.
/// Every call throws as fail_to_write() does.
class LogFile {
 public:
  /// Makes the file, or empties it.
  explicit LogFile(std::filesystem::path name)
      : name_(std::move(name)),
        descriptor_(::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail_to_write(name_, errno);
  }
  ~LogFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  void append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) fail_to_write(name_, errno);
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void sync() {
    if (const int error = io::sync(descriptor_); error != 0) fail_to_write(name_, error);
  }

  /// Synced and closed; nothing can be appended any more.
  void finish() {
    sync();
    if (::close(std::exchange(descriptor_, -1)) != 0) fail_to_write(name_, errno);
  }

 private:
  std::filesystem::path name_;
  int descriptor_;
};

}  // namespace geoloc::io
