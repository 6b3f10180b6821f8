// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "geoloc/io/sync.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// The temporary name of a file while it is written, beside its own: readers see either the old content or
/// the new. A file that is not committed is removed.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path file) : file_(std::move(file)), name_(file_) {
    name_ += ".partial-" + std::to_string(::getpid());
  }
  ~PartialFile() {
    std::error_code ignored;
    if (!is_committed_) std::filesystem::remove(name_, ignored);
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// The name to write to; close the file before commit().
  const std::filesystem::path& name() const { return name_; }

  /// The file is complete: renames it to its own name. A power cut leaves either the old content or the new.
  /// Throws as fail_to_write() does.
  void commit() {
    sync(name_);
    std::error_code error;
    std::filesystem::rename(name_, file_, error);
    if (error) fail_to_write(file_, error.value());
    is_committed_ = true;
    sync_name(file_);
  }

 private:
  std::filesystem::path file_;
  std::filesystem::path name_;
  bool is_committed_ = false;
};

}  // namespace geoloc::io
