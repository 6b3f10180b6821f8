// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// State of a live run at one moment, as text and figures for people.
struct LiveStatus {
  HostTime at;
  Duration elapsed{};  ///< since the program began
  std::string link;    ///< "vehicle 1: telemetry comes"
  bool link_is_good = false;
  double attitude_rate_hz = 0.0;
  double position_rate_hz = 0.0;
  std::string video;  ///< "video: frames come"
  bool video_is_good = false;
  std::string video_state;  ///< one word
  double video_rate_hz = 0.0;
  std::string frame_time;   ///< where capture times come from: "recovered", "arrival"
  std::string clock;        ///< what the clocks last did that they should not, or empty
  std::string warning;      ///< what is wrong with the frames, or empty
  std::string fleet;        ///< how the flight's summaries get to its fleet; empty: it has none
  double detect_ms = 0.0;   ///< of one frame, mean
  double latency_ms = 0.0;  ///< from capture to result, mean
  std::uint64_t frames = 0;
  std::uint64_t frames_unusable = 0;  ///< without vehicle state
  std::uint64_t frames_damaged = 0;   ///< left out; not among the frames
  std::uint64_t packets_lost = 0;     ///< of the stream
  std::uint64_t objects = 0;          ///< confirmed
  std::uint64_t tentative = 0;
  std::uint64_t frames_searched = 0;  ///< by the detector
  std::uint64_t frames_dropped = 0;   ///< a newer one came while it was busy
};

}  // namespace geoloc::io
