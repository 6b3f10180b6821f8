// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace geoloc::io {

/// Where bytes of a link come from.
struct LinkSource {
  std::array<std::uint8_t, 16> address{};  ///< IPv6, or IPv4 mapped into it
  std::uint16_t port = 0;
};

inline bool operator==(const LinkSource& a, const LinkSource& b) {
  return a.address == b.address && a.port == b.port;
}
inline bool operator!=(const LinkSource& a, const LinkSource& b) {
  return !(a == b);
}

/// "192.168.1.7:14550" or "[fe80::1]:14550"
std::string to_string(const LinkSource& source);

}  // namespace geoloc::io
