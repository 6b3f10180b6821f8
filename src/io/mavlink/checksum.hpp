// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace geoloc::io {

/// CRC-16/MCRF4XX, MAVLink's checksum.
class Checksum {
 public:
  void add(std::uint8_t byte) {
    auto mixed = static_cast<std::uint8_t>(byte ^ (value_ & 0xFF));
    mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4));
    value_ = static_cast<std::uint16_t>((value_ >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
  }
  std::uint16_t value() const { return value_; }

 private:
  std::uint16_t value_ = 0xFFFF;
};

}  // namespace geoloc::io
