// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gio/gio.h>
#include <gst/rtsp/gstrtspurl.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "file_descriptor.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/video/video_config.hpp"
#include "io/gst/gst_handles.hpp"

struct pollfd;

namespace geoloc::io {

using RtspUrlPtr = std::unique_ptr<GstRTSPUrl, Releaser<gst_rtsp_url_free>>;

/// The connection between rtspsrc and a server. rtspsrc waits for as long as bytes drip in, stores whatever
/// body a server announces, and follows redirections without end; so it gets a port of the loopback, as its
/// proxy, and what is beyond can be bounded and cut at any moment. It runs in a thread of its own.
class StreamRelay {
 public:
  /// Why no more connections are made.
  struct End {
    std::string why;
    bool is_server_at_fault = false;  ///< it is there, but not to be believed
  };

  /// Throws std::invalid_argument for an address without a host, std::system_error without a port.
  StreamRelay(const std::string& url, RtspTransport transport);
  /// Cuts at once.
  ~StreamRelay();
  StreamRelay(const StreamRelay&) = delete;
  StreamRelay& operator=(const StreamRelay&) = delete;

  /// For rtspsrc's property "proxy".
  std::string address() const;

  /// The server of the address: host and port.
  GSocketConnectable* server() const { return server_.get(); }

  /// A frame came: what the server sent was worth it. Over UDP, frames do not come this way.
  void note_frame();

  /// Leaves a server so much time for a last answer, then cuts.
  void cut_within(Duration grace);

  std::optional<End> end() const;

  /// More bytes than between any two frames.
  static constexpr std::uint64_t kMostBytesWithoutFrame = 64U << 20U;
  /// A session has so many at most: the first, and a few redirections.
  static constexpr int kMostConnections = 4;

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  void relay(const FileDescriptor& client);
  void pump(int client, GSocketConnection* connection, bool is_encrypted);
  std::optional<std::string> first_line(int client) const;
  GObjectPtr<GSocketConnectable> server_of(std::string_view request) const;
  bool wait_for(pollfd* descriptors, std::size_t count) const;
  bool wait_for(int descriptor, short events) const;
  bool send_all(int descriptor, std::string_view bytes) const;
  void end_because(std::string why, bool is_server_at_fault);

  const RtspTransport transport_;
  const GObjectPtr<GSocketConnectable> server_;
  const GObjectPtr<GCancellable> connecting_{g_cancellable_new()};
  std::uint16_t port_ = 0;  // of the listener, which sets it
  FileDescriptor listener_;
  FileDescriptor wake_;
  std::atomic<Clock::time_point> cut_at_{Clock::time_point::max()};
  std::atomic<std::uint64_t> bytes_without_frame_{0};
  mutable std::mutex mutex_;  // guards the end
  std::optional<End> end_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace geoloc::io
