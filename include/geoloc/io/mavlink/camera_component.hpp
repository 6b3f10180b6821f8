// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/mavlink/camera_messages.hpp"
#include "geoloc/io/mavlink/camera_view.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"

namespace geoloc::io {

/// A camera of the vehicle in MAVLink's camera protocol. It announces itself, answers the requests that
/// ground stations send to a tracking camera, and reports the position of the tracked object: the one
/// selected by MAV_CMD_CAMERA_TRACK_POINT, otherwise the nearest. It does no input or output and reads no
/// clock, and it obeys no command that could do harm. Its answers have a budget per second: the link is the
/// vehicle's.
class CameraComponent {
 public:
  using Send = std::function<void(const std::uint8_t* frame, std::size_t size)>;

  /// `component_id`: in the vehicle's system.
  CameraComponent(std::uint8_t component_id, const CameraIntrinsics& image);

  /// A frame of the link, whoever sent it.
  void consume(const std::uint8_t* frame, std::size_t size);

  void update(const CameraView& view);

  /// Sends what is due. Silent until a vehicle is known, and on a MAVLink 1 link.
  void poll(HostTime now, const std::optional<MavAddress>& vehicle, bool is_v2, const Send& send);

 private:
  /// A message that can be requested at an interval.
  struct Stream {
    std::uint32_t message_id;
    std::optional<Duration> period;  ///< nullopt: sent only on request
    std::optional<HostTime> sent_at;
  };

  struct Reply {
    MavAddress to;
    std::uint16_t command = 0;
    std::uint8_t result = 0;
    std::optional<std::uint32_t> message_id;  ///< sent after the answer
  };

  void obey(const Command& command, MavAddress sender);
  void queue(const Reply& reply);
  void send_replies(HostTime now, MavAddress self, const Send& send);
  Reply answer(const Command& command);
  Reply answer_request(std::uint32_t message_id) const;
  std::uint8_t set_interval(const Command& command);
  std::uint8_t track_point(const Command& command);
  bool has_fresh_view(HostTime now) const;
  const CameraTarget* tracked() const;
  void send_message(std::uint32_t message_id, MavAddress self, const Send& send);

  std::uint8_t component_id_;
  CameraIntrinsics image_;
  std::uint8_t system_ = 0;  // of the vehicle; 0: not known
  FrameParser parser_;
  CameraWriter writer_;
  std::optional<CameraView> view_;
  std::optional<std::uint64_t> selected_;
  std::deque<Reply> replies_;
  double replies_allowed_;
  std::optional<HostTime> replies_allowed_at_;
  std::optional<HostTime> last_heartbeat_;
  Stream tracking_{276, std::chrono::seconds{1}, {}};
  Stream field_of_view_{271, {}, {}};
};

}  // namespace geoloc::io
