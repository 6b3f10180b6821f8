// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/sei_unit.hpp"

#include <algorithm>

namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Payload type and size: each 255 that it contains is a byte of its own, and the rest follows.
void append_number(std::size_t number, Bytes& bytes) {
  bytes.insert(bytes.end(), number / 255, 255);
  bytes.push_back(static_cast<std::uint8_t>(number % 255));
}

/// With 3 after each two zeros that a byte up to 3 follows: no start code may stand in the unit (7.4.1).
void append_protected(const Bytes& content, Bytes& unit) {
  int zeros = 0;
  for (const std::uint8_t byte : content) {
    if (zeros == 2 && byte <= 3) {
      unit.push_back(3);
      zeros = 0;
    }
    unit.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
}

}  // namespace

Bytes sei_unit(const std::array<std::uint8_t, 16>& uuid, std::string_view data) {
  constexpr std::uint8_t kSei = 6, kUserDataUnregistered = 5, kTrailingBits = 0x80;
  Bytes content;
  append_number(kUserDataUnregistered, content);
  append_number(uuid.size() + data.size(), content);
  content.insert(content.end(), uuid.begin(), uuid.end());
  content.insert(content.end(), data.begin(), data.end());
  content.push_back(kTrailingBits);
  Bytes unit{0, 0, 0, 1, kSei};
  append_protected(content, unit);
  return unit;
}

std::size_t first_slice(const std::uint8_t* access_unit, std::size_t size) {
  constexpr std::array<std::uint8_t, 3> kStartCode{0, 0, 1};
  constexpr unsigned kTypeMask = 31, kFirstSliceType = 1, kLastSliceType = 5;
  const std::uint8_t* const end = access_unit + size;
  const std::uint8_t* at = access_unit;
  while ((at = std::search(at, end, kStartCode.begin(), kStartCode.end())) != end) {
    const std::uint8_t* const code = at;
    at += kStartCode.size();
    if (at == end) break;
    const unsigned type = *at & kTypeMask;
    if (type < kFirstSliceType || type > kLastSliceType) continue;
    const bool is_long = code != access_unit && code[-1] == 0;
    return static_cast<std::size_t>(code - access_unit) - (is_long ? 1 : 0);
  }
  return size;
}

}  // namespace geoloc::io
