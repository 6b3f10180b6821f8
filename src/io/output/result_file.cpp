// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/result_file.hpp"

#include <stdexcept>

#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/kept_file.hpp"
#include "geoloc/io/output_place.hpp"

namespace geoloc::io {

void keep_and_tell(const std::filesystem::path& file, const TellUser& tell) {
  if (const auto kept = keep_beside(output_place(file).path))
    tell(file.string() + ": the file of an earlier run is kept as " + kept->filename().string());
}

ResultFile::Identity::Identity(const struct stat& status)
    : device(status.st_dev),
      inode(status.st_ino),
      modified_ns(status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec) {}

bool ResultFile::Identity::operator==(const Identity& other) const {
  return device == other.device && inode == other.inode && modified_ns == other.modified_ns;
}

/// nullopt where there is no file, or a device or pipe of that name.
std::optional<ResultFile::Identity> ResultFile::identity() const {
  struct stat status {};
  if (::stat(name_.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return Identity(status);
}

void ResultFile::write(std::string_view content) {
  if (old_file_ == OldFile::kKeep) {
    const auto there = identity();
    if (written_ && there && !(*there == *written_))
      throw std::runtime_error(name_.string() + ": another program writes it, too: name another file");
    if (!written_) keep_and_tell(name_, tell_);
  }
  write_file_atomically(name_, content);
  written_ = identity();
}

}  // namespace geoloc::io
