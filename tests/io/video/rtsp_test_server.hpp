// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "geoloc/io/host_clock.hpp"

namespace geoloc::io::test {

struct ServerOptions {
  std::string encoder =
      "x264enc tune=zerolatency speed-preset=ultrafast key-int-max=10 ! h264parse ! rtph264pay";
  int width_px = 320;
  int height_px = 240;
  bool has_utc = true;     ///< else its sender reports are on a clock that began when it did
  std::uint16_t port = 0;  ///< 0: chosen by the system
};

/// A camera of 20 frames a second at rtsp://127.0.0.1:port/camera, with a key frame twice a second and
/// several sender reports a second. Every picture carries the time it stands for. Dies with all its
/// connections.
class RtspTestServer {
 public:
  RtspTestServer(const ServerOptions& options, const HostClock& clock);
  ~RtspTestServer();
  RtspTestServer(const RtspTestServer&) = delete;
  RtspTestServer& operator=(const RtspTestServer&) = delete;

  std::uint16_t port() const;
  std::string url() const;

  void freeze(bool frozen);      ///< connected, but nothing comes
  void lose_packets(int count);  ///< the next ones of the stream
  void resize(int width_px, int height_px);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The time that a picture of the server carries; nullopt where it cannot be read.
std::optional<HostTime> stamped_time(const cv::Mat& bgr);

}  // namespace geoloc::io::test
