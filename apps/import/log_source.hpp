// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/recording/tlog.hpp"
#include "import/flight_track.hpp"
#include "import/video_offset.hpp"

namespace geoloc::apps {

/// The log beside a video: one of both.
struct LogSource {
  std::optional<FlightTrack> track;
  std::optional<io::Tlog> telemetry;  ///< a MAVLink log, which goes into the recording as it is
  LogTimes times;
  HostTime begins_at;                   ///< on the clock of the recording
  std::optional<double> focal_35mm_mm;  ///< the camera's equivalent for film of 35 mm, where the log tells it
};

/// The format is told by the name's extension. Throws std::runtime_error naming file and fault.
LogSource read_log(const std::filesystem::path& file, const TrackFacts& facts);

}  // namespace geoloc::apps
