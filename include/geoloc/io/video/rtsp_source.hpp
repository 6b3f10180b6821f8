// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geoloc/io/encoded_video.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/video_config.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::io {

/// A live camera over RTSP: H.264, and H.265 where a decoder is installed. It connects in a thread of its own
/// and retries for as long as it lives, whatever the server does.
class RtspSource final : public VideoSource {
 public:
  /// Throws std::invalid_argument for a bad address or configuration, std::runtime_error naming the missing
  /// GStreamer element and its package. A server that cannot be reached is no error. `clock` must outlive the
  /// source. `taker` gets the stream as it comes; nullptr: nobody wants it.
  RtspSource(std::string url, const VideoConfig& config, const HostClock& clock,
             std::shared_ptr<EncodedVideoTaker> taker = nullptr);
  ~RtspSource() override;
  RtspSource(const RtspSource&) = delete;
  RtspSource& operator=(const RtspSource&) = delete;

  std::optional<VideoFrame> next(Duration timeout) override;
  std::vector<FrameTelemetry> take_telemetry() override;
  VideoStatus status() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
