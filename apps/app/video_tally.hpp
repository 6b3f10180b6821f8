// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/detection_worker.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// What became of the frames that came whole.
struct VideoTally {
  std::uint64_t searched = 0;
  std::uint64_t dropped = 0;  ///< a newer one came while the detector was busy
  double detect_ms = 0.0;     ///< of one frame, mean
};

VideoTally tally_of(const io::VideoStatus& video, const DetectionWorker::Stats& detection);

/// 1 where no frame came.
double searched_share(const VideoTally& tally);

/// That this computer is too slow for the stream, and what would help; empty where it is not.
std::string slowness(const VideoTally& tally);

}  // namespace geoloc::apps
