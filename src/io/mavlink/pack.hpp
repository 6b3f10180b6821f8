// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <all/mavlink.h>

#include "geoloc/io/mavlink/commands.hpp"

namespace geoloc::io {

template <typename Fields>
using Encode = std::uint16_t (*)(std::uint8_t, std::uint8_t, mavlink_status_t*, mavlink_message_t*,
                                 const Fields*);

/// The generated encoders keep their state in a mavlink_status_t: here for one call, so that none of it is
/// global.
template <typename Fields>
OutgoingFrame pack(MavAddress self, std::uint8_t sequence, bool use_v2, Encode<Fields> encode,
                   const Fields& fields) {
  mavlink_status_t status{};
  status.flags = use_v2 ? 0 : MAVLINK_STATUS_FLAG_OUT_MAVLINK1;
  status.current_tx_seq = sequence;
  mavlink_message_t message{};
  encode(self.system, self.component, &status, &message, &fields);
  OutgoingFrame frame;
  static_assert(sizeof frame.bytes >= MAVLINK_MAX_PACKET_LEN);
  frame.size = mavlink_msg_to_send_buffer(frame.bytes.data(), &message);
  return frame;
}

/// The HEARTBEAT of a component that is no autopilot.
inline OutgoingFrame pack_heartbeat(MavAddress self, std::uint8_t sequence, bool use_v2, MAV_TYPE type) {
  mavlink_heartbeat_t fields{};
  fields.type = type;
  fields.autopilot = MAV_AUTOPILOT_INVALID;
  fields.system_status = MAV_STATE_ACTIVE;
  fields.mavlink_version = 3;
  return pack(self, sequence, use_v2, mavlink_msg_heartbeat_encode_status, fields);
}

}  // namespace geoloc::io
