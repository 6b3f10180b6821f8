// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::io {

/// How a frame's capture time was obtained.
enum class TimeQuality {
  kArrival,       ///< when the frame arrived, minus the configured latency
  kForeignClock,  ///< from the sender's clock, which is not UTC: spacing exact, offset as good as kArrival's
                  ///< best
  kUnconfirmed,   ///< from the sender's first report, not confirmed yet
  kRecovered,     ///< from reports that agree: the sender's own UTC time of capture
  kFile,          ///< from the time stamps of a file
  kTelemetry      ///< from the telemetry in the frame: when it was put into the stream, by the camera's clock
};

const char* to_string(TimeQuality quality);

/// Telemetry that came in a frame.
struct FrameTelemetry {
  HostTime made_at;  ///< VideoTelemetry::made_at on the host's clock (CameraClock)
  VideoTelemetry record;
};

struct VideoFrame {
  cv::Mat bgr;           ///< 8 bits, 3 channels, not empty; not shared
  HostTime captured_at;  ///< whole microseconds
  HostTime received_at;  ///< when the frame's first packet arrived (a file: when it was decoded)
  TimeQuality time_quality = TimeQuality::kArrival;
  bool damaged = false;  ///< some of its data was lost, or of a picture it refers to
  std::optional<FrameTelemetry> telemetry = std::nullopt;  ///< where it carries any
};

}  // namespace geoloc::io
