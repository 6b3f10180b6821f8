// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace geoloc::io {

/// What a writer throws.
class WriteFailure : public std::runtime_error {
 public:
  WriteFailure(const std::filesystem::path& file, int error)
      : std::runtime_error(file.string() + ": cannot be written: " + std::generic_category().message(error)),
        error_(error) {}

  /// Whether it is the disk's fault rather than the name's.
  bool is_of_disk() const { return error_ == ENOSPC || error_ == EDQUOT || error_ == EIO || error_ == EROFS; }

 private:
  int error_;
};

/// Throws WriteFailure naming the file and the system's reason; an error of 0 is read as EIO.
[[noreturn]] inline void fail_to_write(const std::filesystem::path& file, int error) {
  throw WriteFailure(file, error != 0 ? error : EIO);
}

/// Does what writes to the file, and returns its result; a std::system_error of it becomes that of
/// fail_to_write().
template <typename Step>
auto write_to(const std::filesystem::path& file, const Step& step) {
  try {
    return step();
  } catch (const std::system_error& error) {
    fail_to_write(file, error.code().value());
  }
}

}  // namespace geoloc::io
