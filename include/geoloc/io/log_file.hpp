// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "geoloc/io/output_stream.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// A file that grows. What was appended survives a crash of the program, and after sync() a power cut, too.
/// Every call throws as fail_to_write() does.
class LogFile {
 public:
  /// Makes the file, or empties it.
  explicit LogFile(std::filesystem::path name)
      : name_(std::move(name)), stream_(write_to(name_, [this] { return OutputStream::file(name_); })) {}

  void append(std::string_view bytes) {
    write_to(name_, [&] { stream_.write(bytes); });
  }

  void sync() {
    write_to(name_, [this] { stream_.sync(); });
  }

  /// Synced and closed; nothing can be appended any more.
  void finish() {
    sync();
    write_to(name_, [this] { stream_.close(); });
  }

 private:
  std::filesystem::path name_;
  OutputStream stream_;
};

}  // namespace geoloc::io
