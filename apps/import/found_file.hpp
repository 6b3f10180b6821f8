// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/log_file.hpp"

namespace geoloc::apps {

/// What was seen in a frame of a video.
struct VideoLook {
  std::uint64_t frame = 0;  ///< counted from 0
  Duration time{};          ///< since the video's beginning
  std::vector<Detection> detections;
};

/// Keeps what a detector has found so far beside the recording that is being made, so that an import that was
/// stopped goes on where it was.
class FoundFile {
 public:
  /// `work` names the video and the detector. Throws std::runtime_error where the file is of other work.
  FoundFile(std::filesystem::path file, const std::string& work);

  /// What was found before.
  const std::vector<VideoLook>& looks() const { return looks_; }

  /// Adds what was seen in the next frame. Throws std::runtime_error where the disk does not take it.
  void add(VideoLook look);

  /// It is no longer needed.
  void remove();

  const std::filesystem::path& name() const { return file_; }

 private:
  std::filesystem::path file_;
  std::vector<VideoLook> looks_;
  std::optional<io::LogFile> log_;
};

}  // namespace geoloc::apps
