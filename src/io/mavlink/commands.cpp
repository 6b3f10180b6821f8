// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/commands.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pack.hpp"

namespace geoloc::io {

OutgoingFrame CommandWriter::heartbeat(MavAddress self) {
  return pack_heartbeat(self, sequence_++, use_v2_, MAV_TYPE_ONBOARD_CONTROLLER);
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

OutgoingFrame CommandWriter::status_text(MavAddress self, const std::string& text) {
  mavlink_statustext_t fields{};
  fields.severity = MAV_SEVERITY_INFO;
  std::memcpy(fields.text, text.data(), std::min(text.size(), sizeof fields.text));
  return pack(self, sequence_++, use_v2_, mavlink_msg_statustext_encode_status, fields);
}

}  // namespace geoloc::io
