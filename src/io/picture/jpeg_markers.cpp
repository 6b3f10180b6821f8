// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/picture/picture_file.hpp"

// Markers are those of ITU-T T.81, annex B.
namespace geoloc::io {
namespace {

constexpr unsigned kEndOfImage = 0xD9, kStartOfScan = 0xDA;

unsigned byte_at(std::string_view bytes, std::size_t position) {
  return static_cast<unsigned char>(bytes[position]);
}

/// Whether the marker has no length field: restart markers, and the one for private use.
bool stands_alone(unsigned marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
}

/// Finds the next marker from `position` on and moves `position` past it; 0 at the end. It skips coded data
/// (where FF is followed by 00), restarts and fill bytes.
unsigned next_marker(std::string_view bytes, std::size_t& position) {
  while (position + 1 < bytes.size()) {
    const unsigned marker = byte_at(bytes, position) == 0xFF ? byte_at(bytes, position + 1) : 0;
    ++position;
    if (marker == 0x00 || marker == 0xFF || stands_alone(marker)) continue;
    ++position;
    return marker;
  }
  return 0;
}

}  // namespace

bool is_whole_jpeg(std::string_view bytes) {
  std::size_t position = 2;  // after the start marker
  bool has_scan = false;
  while (const unsigned marker = next_marker(bytes, position)) {
    if (marker == kEndOfImage) return has_scan;
    has_scan = has_scan || marker == kStartOfScan;
    if (position + 1 >= bytes.size()) return false;
    position += byte_at(bytes, position) << 8U | byte_at(bytes, position + 1);
  }
  return false;
}

}  // namespace geoloc::io
