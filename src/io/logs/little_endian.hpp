// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>

namespace geoloc::io {

/// A number of a log, which both formats write as a little-endian machine has it, and so does this one.
template <typename Number>
Number read_number(const char* bytes) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "logs are read as they lie in memory");
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

}  // namespace geoloc::io
