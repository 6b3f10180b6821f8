// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <all/mavlink.h>

#include <cstring>

#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::io {

/// Decodes with the generated decoders, which pad short payloads.
template <typename Fields>
Fields unpack(const Frame& frame, void (*decode_fields)(const mavlink_message_t*, Fields*)) {
  mavlink_message_t message{};
  message.len = static_cast<std::uint8_t>(frame.payload_size);
  std::memcpy(message.payload64, frame.payload, frame.payload_size);
  Fields fields{};
  decode_fields(&message, &fields);
  return fields;
}

}  // namespace geoloc::io
