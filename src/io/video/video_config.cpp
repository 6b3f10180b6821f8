// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/video_config.hpp"

#include "geoloc/geometry/problems.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::io {

const char* to_string(RtspTransport transport) {
  return transport == RtspTransport::kTcp ? "tcp" : "udp";
}

const char* to_string(TimeQuality quality) {
  switch (quality) {
    case TimeQuality::kArrival:
      return "arrival";
    case TimeQuality::kForeignClock:
      return "foreign clock";
    case TimeQuality::kUnconfirmed:
      return "unconfirmed";
    case TimeQuality::kRecovered:
      return "recovered";
    case TimeQuality::kFile:
      return "file";
  }
  return "unknown";
}

const char* to_string(VideoState state) {
  switch (state) {
    case VideoState::kConnecting:
      return "connecting";
    case VideoState::kPlaying:
      return "playing";
    case VideoState::kRetrying:
      return "retrying";
    case VideoState::kEnded:
      return "ended";
  }
  return "unknown";
}

std::vector<std::string> VideoConfig::problems() const {
  Problems found;
  found.require(latency_s >= 0 && latency_s <= 10, "video.latency_s must lie in [0, 10]");
  found.require(reorder_s >= 0 && reorder_s <= 2, "video.reorder_s must lie in [0, 2]");
  found.require(frame_timeout_s >= 0.2 && frame_timeout_s <= 60,
                "video.frame_timeout_s must lie in [0.2, 60]");
  found.require(connect_timeout_s >= 0.5 && connect_timeout_s <= 60,
                "video.connect_timeout_s must lie in [0.5, 60]");
  found.require(retry_min_s >= 0.05 && retry_min_s <= 60, "video.retry_min_s must lie in [0.05, 60]");
  found.require(retry_max_s >= retry_min_s && retry_max_s <= 60,
                "video.retry_max_s must lie between video.retry_min_s and 60");
  found.require(max_megapixels > 0 && max_megapixels <= 1000, "video.max_megapixels must lie in (0, 1000]");
  return found.take();
}

}  // namespace geoloc::io
