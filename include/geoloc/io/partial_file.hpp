// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "geoloc/io/output_place.hpp"
#include "geoloc/io/output_stream.hpp"
#include "geoloc/io/sync.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {

/// The temporary name of a file while it is written, beside its own: readers see either the old content or
/// the new. A file that is not committed is removed. Links are followed; a device, FIFO or socket has no
/// temporary name, and stays.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path file)
      : file_(std::move(file)), place_(output_place(file_)), name_(place_.path) {
    if (place_.is_file) name_ += ".partial-" + std::to_string(::getpid());
  }
  ~PartialFile() {
    std::error_code ignored;
    if (place_.is_file && !is_committed_) std::filesystem::remove(name_, ignored);
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// The name to write to; close the file before commit().
  const std::filesystem::path& name() const { return name_; }

  /// Opens it for writing. Throws std::system_error.
  OutputStream open() const {
    return place_.is_file ? OutputStream::file(name_) : OutputStream::device(name_);
  }

  /// The file is complete: renames it to its own name. A power cut leaves either the old content or the new.
  /// Throws as fail_to_write() does.
  void commit() {
    if (!place_.is_file) return;
    sync(name_);
    std::error_code error;
    std::filesystem::rename(name_, place_.path, error);
    if (error) fail_to_write(file_, error.value());
    is_committed_ = true;
    sync_name(place_.path);
  }

 private:
  std::filesystem::path file_;  // as it was named
  OutputPlace place_;
  std::filesystem::path name_;
  bool is_committed_ = false;
};

}  // namespace geoloc::io
