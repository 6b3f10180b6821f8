// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/logs/flight_log.hpp"

namespace geoloc::apps {

/// What is known of when a video was recorded.
struct VideoTimes {
  std::optional<HostTime> created_at;  ///< as the file tells, UTC
  std::optional<Duration> length;
};

/// The log's side.
struct LogTimes {
  Duration length{};
  std::optional<HostTime> begins_at;  ///< UTC
  std::optional<Duration>
      begins_in_video;               ///< of a log that counts from the video's beginning: DJI's subtitles
  std::vector<Duration> recordings;  ///< beginnings of videos, as the camera tells, since the log's beginning
  std::vector<Duration> video_starts;  ///< commands to begin one
  std::vector<Duration> exposures;     ///< of pictures
};

/// Adds the beginning of a video, in the order in which they are told. Within seconds of the last one it is
/// the same, told again.
void add_start(std::vector<Duration>& starts, Duration start);

/// When the video's time 0 was.
struct VideoOffset {
  Duration after_log_begin{};
  double sigma_s = 0.0;  ///< 1-sigma of it: the prior of the latency
  std::string how;       ///< for people
};

/// `told`: by the user. Throws std::runtime_error where nothing tells, or video and log do not overlap.
VideoOffset find_offset(const VideoTimes& video, const LogTimes& log, std::optional<Duration> told);

}  // namespace geoloc::apps
