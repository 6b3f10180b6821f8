// SPDX-License-Identifier: Apache-2.0
#include "io/logs/plain_numbers.hpp"

#include <cstdint>

#include "io/logs/little_endian.hpp"

namespace geoloc::io {

std::size_t plain_size(char type) {
  switch (type) {
    case 'b':
    case 'B':
      return 1;
    case 'h':
    case 'H':
      return 2;
    case 'i':
    case 'I':
    case 'f':
      return 4;
    case 'q':
    case 'Q':
    case 'd':
      return 8;
    default:
      return 0;
  }
}

std::optional<double> plain_number(char type, const char* bytes) {
  switch (type) {
    case 'b':
      return read_number<std::int8_t>(bytes);
    case 'B':
      return read_number<std::uint8_t>(bytes);
    case 'h':
      return read_number<std::int16_t>(bytes);
    case 'H':
      return read_number<std::uint16_t>(bytes);
    case 'i':
      return read_number<std::int32_t>(bytes);
    case 'I':
      return read_number<std::uint32_t>(bytes);
    case 'q':
      return static_cast<double>(read_number<std::int64_t>(bytes));
    case 'Q':
      return static_cast<double>(read_number<std::uint64_t>(bytes));
    case 'f':
      return read_number<float>(bytes);
    case 'd':
      return read_number<double>(bytes);
    default:
      return std::nullopt;
  }
}

}  // namespace geoloc::io
