// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/camera_receiver.hpp"
#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/stream_requests.hpp"

namespace geoloc::io {

/// What a VehicleLink sends, each kind when it is due: heartbeats, TIMESYNC requests, requests for messages,
/// and lines for people. It reads nothing of what comes in.
class LinkSender {
 public:
  using Send = std::function<void(const std::uint8_t* frame, std::size_t size)>;

  /// Who speaks to whom, and how.
  struct Peers {
    MavAddress self;
    MavAddress vehicle;
    bool speaks_v2;
  };

  /// Keeps the link known to the vehicle, which may be out of reach.
  void send_heartbeat(HostTime now, const Peers& peers, const Send& send);

  /// All else, to a vehicle that is heard.
  void send_due(HostTime now, const Peers& peers, bool is_clock_in_doubt, StreamRequests& of_vehicle,
                CameraReceiver& camera, const Send& send);

  /// Queues a line for the people at the ground stations (STATUSTEXT), at most two per second.
  void say(const std::string& text);

  /// The vehicle's clock is not known any more: the next TIMESYNC requests follow each other quickly.
  void seek_clock() { fast_timesyncs_ = 0; }

 private:
  void send_timesync(HostTime now, const Peers& peers, bool is_clock_in_doubt, const Send& send);
  void send_requests(HostTime now, const Peers& peers, StreamRequests& of_vehicle, CameraReceiver& camera,
                     const Send& send);
  void send_text(HostTime now, const Peers& peers, const Send& send);

  CommandWriter writer_;
  std::optional<HostTime> last_heartbeat_;
  std::optional<HostTime> last_timesync_;
  int fast_timesyncs_ = 0;
  std::deque<std::string> texts_;
  std::optional<HostTime> last_text_;
};

}  // namespace geoloc::io
