// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/commands.hpp"

#include <all/mavlink.h>

#include <cmath>

namespace geoloc::io {
namespace {

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

}  // namespace

OutgoingFrame CommandWriter::heartbeat(MavAddress self) {
  mavlink_heartbeat_t fields{};
  fields.type = MAV_TYPE_ONBOARD_CONTROLLER;
  fields.autopilot = MAV_AUTOPILOT_INVALID;
  fields.system_status = MAV_STATE_ACTIVE;
  fields.mavlink_version = 3;
  return pack(self, sequence_++, use_v2_, mavlink_msg_heartbeat_encode_status, fields);
}

OutgoingFrame CommandWriter::set_message_interval(MavAddress self, MavAddress vehicle,
                                                  std::uint32_t message_id, double rate_hz) {
  mavlink_command_long_t fields{};
  fields.command = MAV_CMD_SET_MESSAGE_INTERVAL;
  fields.target_system = vehicle.system;
  fields.target_component = vehicle.component;
  fields.param1 = static_cast<float>(message_id);
  fields.param2 = static_cast<float>(std::round(1e6 / rate_hz));  // [us]
  return pack(self, sequence_++, use_v2_, mavlink_msg_command_long_encode_status, fields);
}

OutgoingFrame CommandWriter::request_data_stream(MavAddress self, MavAddress vehicle, std::uint8_t stream_id,
                                                 double rate_hz) {
  mavlink_request_data_stream_t fields{};
  fields.target_system = vehicle.system;
  fields.target_component = vehicle.component;
  fields.req_stream_id = stream_id;
  fields.req_message_rate = static_cast<std::uint16_t>(std::ceil(rate_hz));
  fields.start_stop = 1;
  return pack(self, sequence_++, use_v2_, mavlink_msg_request_data_stream_encode_status, fields);
}

OutgoingFrame CommandWriter::timesync_request(MavAddress self, std::int64_t requester_ns) {
  mavlink_timesync_t fields{};
  fields.ts1 = requester_ns;
  return pack(self, sequence_++, use_v2_, mavlink_msg_timesync_encode_status, fields);
}

}  // namespace geoloc::io
