// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/logs/flight_log.hpp"
#include "geoloc/io/recording/tlog.hpp"
#include "import/flight_track.hpp"
#include "import/video_offset.hpp"

namespace geoloc::apps {

/// The log beside a video: one of both.
struct LogSource {
  std::optional<FlightTrack> track;
  std::optional<io::Tlog> telemetry;  ///< a MAVLink log, which goes into the recording as it is
  bool telemetry_has_gimbal = false;  ///< its messages tell a gimbal's angles
  LogTimes times;
  HostTime begins_at;                                ///< on the clock of the recording
  std::vector<io::LoggedFocalLength> focal_lengths;  ///< as FlightLog's

  bool has_gimbal() const { return telemetry_has_gimbal || (track && !track->gimbal.empty()); }
};

/// The format is told by the name's extension. Throws std::runtime_error naming file and fault.
LogSource read_log(const std::filesystem::path& file, const TrackFacts& facts);

}  // namespace geoloc::apps
