// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace geoloc::io {

/// What becomes of the file that an earlier run left under the name of an output.
enum class OldFile {
  kReplace,  ///< it is written anew: a replay can be repeated
  kKeep      ///< it is kept beside (keep_beside()): a flight cannot
};

/// Shows a message to the user.
using TellUser = std::function<void(const std::string& message)>;

/// Calls keep_beside(), and tells the user what was kept.
void keep_and_tell(const std::filesystem::path& file, const TellUser& tell);

/// A file that a run writes anew now and then.
class ResultFile {
 public:
  ResultFile(std::filesystem::path name, OldFile old_file, TellUser tell)
      : name_(std::move(name)), old_file_(old_file), tell_(std::move(tell)) {}

  const std::filesystem::path& name() const { return name_; }

  /// As write_file_atomically(). With kKeep, what this run has not written is kept: an earlier file beside
  /// the new one, and one that came since, in its place. For the latter it throws std::runtime_error.
  void write(std::string_view content);

 private:
  /// Tells files of one name from each other.
  struct Identity {
    explicit Identity(const struct stat& status);
    bool operator==(const Identity& other) const;

    dev_t device;
    ino_t inode;
    std::int64_t modified_ns;
  };

  std::optional<Identity> identity() const;

  std::filesystem::path name_;
  OldFile old_file_;
  TellUser tell_;
  std::optional<Identity> written_;  // what this run wrote last
};

}  // namespace geoloc::io
