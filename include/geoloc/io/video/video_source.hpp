// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::io {

enum class VideoState {
  kConnecting,  ///< no frame yet
  kPlaying,     ///< frames arrive
  kRetrying,    ///< the connection failed; another attempt follows
  kEnded        ///< no more frames will come
};

const char* to_string(VideoState state);

struct VideoStatus {
  VideoState state = VideoState::kConnecting;
  std::string last_error;          ///< why the last attempt ended, without credentials; stays after recovery
  double frames_per_second = 0.0;  ///< decoded, mean over the last two seconds
  TimeQuality time_quality = TimeQuality::kArrival;  ///< of the newest frame
  std::uint64_t frames = 0;                          ///< decoded
  std::uint64_t dropped = 0;                         ///< replaced by a newer one before they were taken
  std::uint64_t damaged = 0;                         ///< see VideoFrame::damaged
  std::uint64_t refused = 0;         ///< not usable as pictures: empty, absurdly large, without time
  std::uint64_t with_telemetry = 0;  ///< frames that carried telemetry
  std::uint64_t packets = 0;         ///< that came
  std::uint64_t lost_packets = 0;
  std::uint64_t attempts = 0;  ///< connections tried, the first one included
};

/// A source of camera frames. One thread calls next(); any thread may call status().
class VideoSource {
 public:
  virtual ~VideoSource() = default;

  /// The newest frame not yet returned; waits up to `timeout` for one. A live source drops what the caller
  /// was too slow for, so a backlog never builds up. Returns at once, empty, where state is kEnded. The size
  /// of the pictures may change from one frame to the next.
  virtual std::optional<VideoFrame> next(Duration timeout) = 0;

  /// The telemetry of all frames since the last call, in their order, also of those that next() left out.
  /// What nobody takes is forgotten after some seconds.
  virtual std::vector<FrameTelemetry> take_telemetry() { return {}; }

  virtual VideoStatus status() const = 0;

 protected:
  VideoSource() = default;
  VideoSource(const VideoSource&) = default;
  VideoSource& operator=(const VideoSource&) = default;
};

}  // namespace geoloc::io
