// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace geoloc::io {

/// A sender on a MAVLink network: a vehicle or station, and one of its components.
struct MavAddress {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
};

constexpr bool operator==(MavAddress a, MavAddress b) {
  return a.system == b.system && a.component == b.component;
}
constexpr bool operator!=(MavAddress a, MavAddress b) {
  return !(a == b);
}

/// A MAVLink frame whose checksum was right. Points into the buffer of the parser that found it.
struct Frame {
  const std::uint8_t* bytes = nullptr;  ///< from the magic byte to the checksum, or to the signature's end
  std::size_t size = 0;
  const std::uint8_t* payload = nullptr;
  std::size_t payload_size = 0;  ///< MAVLink 2 cuts trailing zero bytes off
  std::uint32_t message_id = 0;
  MavAddress sender;
  std::uint8_t sequence = 0;
  bool is_v2 = false;
  bool is_signed = false;  ///< signatures are not verified
};

}  // namespace geoloc::io
