// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/message_table.hpp"

#include <all/mavlink.h>

namespace geoloc::io {

std::optional<MessageSpec> message_spec(std::uint32_t message_id) {
  const mavlink_msg_entry_t* const entry = mavlink_get_msg_entry(message_id);
  if (entry == nullptr) return std::nullopt;
  return MessageSpec{entry->crc_extra, entry->min_msg_len, entry->max_msg_len};
}

}  // namespace geoloc::io
