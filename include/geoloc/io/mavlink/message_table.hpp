// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace geoloc::io {

/// What a receiver must know about a message to check its frames.
struct MessageSpec {
  std::uint8_t checksum_seed;  ///< CRC_EXTRA: a hash of the message's fields
  std::uint8_t base_size;      ///< payload without MAVLink 2 extensions
  std::uint8_t full_size;      ///< payload with those that the headers know
};

/// nullopt for a message of no dialect that the generated headers know.
std::optional<MessageSpec> message_spec(std::uint32_t message_id);

}  // namespace geoloc::io
