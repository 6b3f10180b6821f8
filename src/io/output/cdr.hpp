// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace geoloc::io {

/// What is written byte by byte, the lowest first, on any computer.
template <typename Number>
void append_little_endian(Number value, std::string& bytes) {
  static_assert(sizeof(Number) <= sizeof(std::uint64_t));
  std::uint64_t bits = 0;
  if constexpr (std::is_floating_point_v<Number>) {
    static_assert(sizeof(Number) == sizeof(std::uint64_t) || sizeof(Number) == sizeof(std::uint32_t));
    std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t> same;
    std::memcpy(&same, &value, sizeof same);
    bits = same;
  } else {
    bits = static_cast<std::uint64_t>(value);
  }
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes += static_cast<char>(bits >> 8 * i & 0xFF);
}

/// One message in ROS 2's form: OMG CDR 1, little-endian. A number stands at a multiple of its own size.
class CdrMessage {
 public:
  template <typename Number>
  CdrMessage& add(Number value) {
    while ((bytes_.size() - kHead) % sizeof(Number) != 0) bytes_ += '\0';
    append_little_endian(value, bytes_);
    return *this;
  }
  CdrMessage& add(bool value) { return add<std::uint8_t>(value ? 1 : 0); }
  CdrMessage& add_text(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text);
    bytes_ += '\0';
    return *this;
  }
  /// Of a sequence; its entries follow.
  CdrMessage& add_count(std::size_t count) { return add(static_cast<std::uint32_t>(count)); }

  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHead = 4;
  std::string bytes_{"\0\1\0\0", kHead};  // what follows is little-endian
};

}  // namespace geoloc::io
