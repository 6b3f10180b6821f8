// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::io {

/// A frame ready to be sent.
struct OutgoingFrame {
  std::array<std::uint8_t, 280> bytes;
  std::size_t size = 0;
};

/// Writes the few messages that geoloc sends. Each call uses one sequence number of the sender.
class CommandWriter {
 public:
  /// Autopilots that speak MAVLink 1 may switch the whole link to MAVLink 2 as soon as they hear it.
  void use_v2(bool use_v2) { use_v2_ = use_v2; }

  /// HEARTBEAT of an onboard computer.
  OutgoingFrame heartbeat(MavAddress self);

  /// MAV_CMD_SET_MESSAGE_INTERVAL: asks `vehicle` to send `message_id` at `rate_hz`.
  OutgoingFrame set_message_interval(MavAddress self, MavAddress vehicle, std::uint32_t message_id,
                                     double rate_hz);

  /// REQUEST_DATA_STREAM: a whole group of messages, for autopilots that support nothing newer.
  OutgoingFrame request_data_stream(MavAddress self, MavAddress vehicle, std::uint8_t stream_id,
                                    double rate_hz);

  /// TIMESYNC request: requester_ns comes back with the answer.
  OutgoingFrame timesync_request(MavAddress self, std::int64_t requester_ns);

  /// STATUSTEXT for people, limited to 50 characters of ASCII.
  OutgoingFrame status_text(MavAddress self, const std::string& text);

 private:
  std::uint8_t sequence_ = 0;
  bool use_v2_ = true;
};

}  // namespace geoloc::io
