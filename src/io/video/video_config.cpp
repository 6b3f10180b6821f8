// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/video_config.hpp"

#include "geoloc/io/video/video_source.hpp"
#include "io/video/video_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {

const char* to_string(RtspTransport transport) {
  return name_of(transport);
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
    case TimeQuality::kTelemetry:
      return "telemetry";
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
  return check_fields(*this);
}

}  // namespace geoloc::io
