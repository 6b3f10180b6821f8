// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/io/video/video_frame.hpp"
#include "import/found_file.hpp"
#include "import/log_source.hpp"
#include "import/video_camera.hpp"
#include "import/video_offset.hpp"

namespace geoloc::apps {

/// What a video's recording is made of.
struct VideoFlight {
  const LogSource& log;
  const VideoCamera& camera;
  const VideoOffset& offset;
  const std::vector<VideoLook>& looks;
  io::TimeQuality time_quality = io::TimeQuality::kFile;  ///< of the looks
  double time_sigma_s = 0.0;                              ///< 1-sigma of their times; 0: not stated
};

/// Writes camera, settings, telemetry and frames. Returns how many frames were left out since how the camera
/// looked cannot be assumed then.
std::size_t write_video_flight(const VideoFlight& flight, io::RecordingWriter& writer);

}  // namespace geoloc::apps
