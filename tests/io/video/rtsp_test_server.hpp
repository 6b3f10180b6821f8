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
  bool has_utc = true;     ///< otherwise its sender reports use a clock that starts with the server
  std::uint16_t port = 0;  ///< 0: chosen by the system
};

/// A camera of 20 frames per second at rtsp://127.0.0.1:port/camera, with two key frames and several sender
/// reports per second. Every picture shows its own time. Its destructor ends all connections.
class RtspTestServer {
 public:
  RtspTestServer(const ServerOptions& options, const HostClock& clock);
  ~RtspTestServer();
  RtspTestServer(const RtspTestServer&) = delete;
  RtspTestServer& operator=(const RtspTestServer&) = delete;

  std::uint16_t port() const;
  std::string url() const;

  void freeze(bool frozen);      ///< stays connected, but sends nothing
  void lose_packets(int count);  ///< the next ones of the stream
  void resize(int width_px, int height_px);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The time shown in a picture of the server; nullopt if it cannot be read.
std::optional<HostTime> stamped_time(const cv::Mat& bgr);

}  // namespace geoloc::io::test
