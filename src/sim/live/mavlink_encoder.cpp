// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/mavlink_encoder.hpp"

#include <all/mavlink.h>

#include <cstring>

#include "geoloc/io/mavlink/message_table.hpp"

namespace geoloc::sim {

Datagram encode_frame(std::uint32_t message_id, io::MavAddress sender, std::uint8_t sequence,
                      const Payload& payload, bool use_v2) {
  constexpr std::uint32_t kMostInV1 = 255;
  const auto spec = io::message_spec(message_id);
  if (!spec || (!use_v2 && message_id > kMostInV1)) return {};
  mavlink_message_t message{};
  message.msgid = message_id & 0xFFFFFFU;  // three bytes on the wire
  std::memcpy(_MAV_PAYLOAD_NON_CONST(&message), payload.data(), payload.size());
  mavlink_status_t status{};  // of this call alone: the generated code's own is global
  status.current_tx_seq = sequence;
  status.flags = use_v2 ? 0 : MAVLINK_STATUS_FLAG_OUT_MAVLINK1;
  mavlink_finalize_message_buffer(&message, sender.system, sender.component, &status, spec->base_size,
                                  static_cast<std::uint8_t>(payload.size()), spec->checksum_seed);
  Datagram datagram(MAVLINK_MAX_PACKET_LEN);
  datagram.resize(mavlink_msg_to_send_buffer(datagram.data(), &message));
  return datagram;
}

}  // namespace geoloc::sim
