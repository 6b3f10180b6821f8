// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/stop_signal.hpp"
#include "import/found_file.hpp"
#include "import/log_source.hpp"
#include "import/video_offset.hpp"

namespace geoloc::apps {

/// A video whose frames carry the flight's telemetry, which is its log.
struct ToldVideo {
  LogSource log;       ///< what a live run would have been told, as MAVLink
  HostTime begins_at;  ///< when the first frame that tells it was made, by the camera's clock
  VideoOffset offset;  ///< of that frame
  std::vector<std::optional<HostTime>> made_at;  ///< by the number of the frame
  std::optional<double> horizontal_fov_deg;      ///< the first that is told
  bool has_gimbal = false;
  std::vector<std::string> notes;
  std::vector<std::string> assumptions;
};

/// Reads all of the video, with progress, until `stop`. Throws std::runtime_error naming the file where it
/// carries no telemetry.
ToldVideo read_told_video(const std::filesystem::path& file, const StopSignal& stop);

/// Looks at the times that their frames tell, on which the recording's clock is. Those of frames that tell
/// none, or are not later than the one before, are left out; returns how many.
std::size_t take_told_times(const ToldVideo& video, std::vector<VideoLook>& looks);

}  // namespace geoloc::apps
