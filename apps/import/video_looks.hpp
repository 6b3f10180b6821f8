// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/stop_signal.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/stills/labels.hpp"
#include "geoloc/io/video/file_source.hpp"
#include "import/found_file.hpp"

namespace geoloc::apps {

/// Everything that can be known of a video before its frames are looked at.
struct VideoFacts {
  io::FileFacts file;
  int width_px = 0;
  int height_px = 0;
};

/// Throws std::runtime_error naming the file where it holds no video.
VideoFacts video_facts(const std::filesystem::path& file);

/// Whole frames with their numbers from 0, with progress, until `stop` or the video's end. Their times count
/// from 1970. What became of the others is added to `notes`.
void for_each_frame(const std::filesystem::path& file, const char* progress_text, const StopSignal& stop,
                    std::vector<std::string>& notes,
                    const std::function<void(std::uint64_t number, const io::VideoFrame& frame)>& take);

/// What a detector finds, with progress, until `stop`; what `found` already has is not looked at again.
std::vector<VideoLook> detected_looks(const std::filesystem::path& file, io::Detector& detector,
                                      FoundFile& found, const StopSignal& stop,
                                      std::vector<std::string>& notes);

/// What people labelled: a picture's name is, or ends in, the number of its frame, counted from 0. Throws
/// std::runtime_error for a name without one, and where no frame has labels.
std::vector<VideoLook> labelled_looks(const std::filesystem::path& file, const io::Labels& labels,
                                      const std::string& labels_file, const StopSignal& stop,
                                      std::vector<std::string>& notes);

}  // namespace geoloc::apps
