// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtp_payload.hpp"

namespace geoloc::io {
namespace {

struct Bytes {
  const std::uint8_t* data;
  std::size_t size;

  Bytes from(std::size_t offset) const {
    return offset < size ? Bytes{data + offset, size - offset} : Bytes{data, 0};
  }
};

/// The differences between the two payload formats, and the layout of their NAL unit headers.
struct Format {
  std::size_t header_size;  ///< of a NAL unit
  unsigned aggregation;     ///< NAL unit type of a packet with several units in it (STAP-A, AP)
  unsigned fragment;        ///< … with a part of one (FU-A, FU)
  unsigned (*type)(std::uint8_t header);
  bool (*is_random_access)(unsigned type);
  unsigned fragment_type_mask;  ///< of the type in the fragment's own header
};

constexpr Format kH264Format{
    1,  24, 28, [](std::uint8_t header) { return header & 31U; }, [](unsigned type) { return type == 5; },
    31U};
constexpr Format kH265Format{2,
                             48,
                             49,
                             [](std::uint8_t header) { return (header >> 1U) & 63U; },
                             [](unsigned type) { return type >= 16 && type <= 23; },
                             63U};

/// In both codecs a slice header begins with a single 1 bit in the first slice of a picture:
/// first_mb_in_slice = 0 as ue(v), first_slice_segment_in_pic_flag. A later slice proves nothing, as the
/// first may be lost.
bool is_first_slice(Bytes slice_header) {
  return slice_header.size > 0 && (slice_header.data[0] & 0x80U) != 0;
}

bool unit_begins_picture(const Format& format, Bytes unit) {
  return unit.size > format.header_size && format.is_random_access(format.type(unit.data[0])) &&
         is_first_slice(unit.from(format.header_size));
}

bool fragment_begins_picture(const Format& format, Bytes fragment) {
  if (fragment.size == 0) return false;
  const unsigned header = fragment.data[0];
  constexpr unsigned kStart = 0x80;
  return (header & kStart) != 0 && format.is_random_access(header & format.fragment_type_mask) &&
         is_first_slice(fragment.from(1));
}

bool any_unit_begins_picture(const Format& format, Bytes units) {
  constexpr std::size_t kLengthSize = 2;
  while (units.size > kLengthSize) {
    const std::size_t length = static_cast<std::size_t>(units.data[0]) << 8U | units.data[1];
    units = units.from(kLengthSize);
    if (length > units.size) return false;
    if (unit_begins_picture(format, {units.data, length})) return true;
    units = units.from(length);
  }
  return false;
}

}  // namespace

bool begins_random_access_picture(VideoCodec codec, const std::uint8_t* payload, std::size_t size) {
  const Format& format = codec == VideoCodec::kH264 ? kH264Format : kH265Format;
  const Bytes unit{payload, size};
  if (size < format.header_size) return false;
  const unsigned type = format.type(payload[0]);
  if (type == format.aggregation) return any_unit_begins_picture(format, unit.from(format.header_size));
  if (type == format.fragment) return fragment_begins_picture(format, unit.from(format.header_size));
  return unit_begins_picture(format, unit);
}

}  // namespace geoloc::io
