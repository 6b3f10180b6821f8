// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::sim {

struct RtspCameraSettings {
  std::uint16_t port = 8554;    ///< on 127.0.0.1; 0: one that is free
  int width_px = 1280;          ///< even
  int height_px = 720;          ///< even
  double frame_rate_hz = 10.0;  ///< announced; frames go out when they are pushed
  int bitrate_kbps = 4000;      ///< of the H.264 stream

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// Serves pictures as H.264 over RTSP. One stream, encoded once, for all who watch. The stream carries the
/// time each picture is stamped with: RTP timestamps and RTCP sender reports map to that instant in UTC, not
/// to the sending.
class RtspCamera {
 public:
  /// Throws std::invalid_argument naming every problem, std::runtime_error for a port in use or a missing
  /// GStreamer part.
  explicit RtspCamera(const RtspCameraSettings& settings);
  ~RtspCamera();
  RtspCamera(const RtspCamera&) = delete;
  RtspCamera& operator=(const RtspCamera&) = delete;

  std::string url() const;

  /// Whether someone watches: then pictures are wanted.
  bool is_watched() const;

  /// `bgr`: height x width x 3 bytes without gaps; copied. Stamps must rise. `telemetry`, where there is any,
  /// goes into the frame. Does not wait: false where the picture was not taken because nobody watches.
  bool push(const std::uint8_t* bgr, std::chrono::steady_clock::time_point stamp,
            const std::optional<io::VideoTelemetry>& telemetry = std::nullopt);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace geoloc::sim
