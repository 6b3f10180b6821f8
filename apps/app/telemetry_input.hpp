// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/message_box.hpp"
#include "common/session.hpp"
#include "common/telemetry_way.hpp"
#include "common/video_vehicle.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/udp_socket.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// Where the vehicle's telemetry of a live run comes from: from MAVLink or from the video's own frames, never
/// from both. MAVLink that was asked for counts; otherwise the first frames decide, and MAVLink is what is
/// left where they carry none.
class TelemetryInput {
 public:
  struct Settings {
    bool is_mavlink_asked_for = true;
    std::uint8_t video_system = 1;  ///< the MAVLink id of a vehicle that the video tells of
    bool is_on_gimbal = false;      ///< the camera
  };

  /// `socket`: nullptr where its port is not to be had. All must outlive it.
  TelemetryInput(const Settings& settings, io::UdpSocket* socket, io::LinkGuard& guard,
                 io::VideoSource& video, const io::HostClock& clock);

  /// Gives the session what has come; waits some milliseconds for it at most.
  void receive(Session& session);

  /// To the vehicle, where MAVLink reaches it.
  void send(const std::uint8_t* frame, std::size_t size);

  TelemetryWay way() const { return way_; }
  bool can_send() const { return way_ == TelemetryWay::kMavlink && socket_ != nullptr; }
  const io::LinkGuard& guard() const { return guard_; }

  /// For the user, since the last call.
  std::vector<std::string> take_messages() { return messages_.take(); }

 private:
  void decide();
  void receive_datagrams(Session& session);
  void receive_records(Session& session);
  void tell_once(const io::VideoTelemetry& record);

  Settings settings_;
  io::UdpSocket* socket_;
  io::LinkGuard& guard_;
  io::VideoSource& video_;
  const io::HostClock& clock_;
  TelemetryWay way_;
  VideoVehicle vehicle_;
  MessageBox messages_;
  bool has_told_second_ = false;  // that the video carries telemetry, too
  bool has_told_gimbal_ = false;
  bool has_told_refused_ = false;
};

}  // namespace geoloc::apps
