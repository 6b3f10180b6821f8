// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "summary_checks.hpp"

// Numbers and texts of a summary as bytes.
namespace geoloc::io {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are written as they lie in memory");
static_assert(std::numeric_limits<double>::is_iec559);

class ByteWriter {
 public:
  template <typename Number>
  void put(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof(number));
  }
  void put_text(const std::string& text) {
    put(static_cast<std::uint8_t>(text.size()));
    bytes_ += text;
  }
  void put_raw(std::string_view raw) { bytes_ += raw; }
  std::string take() { return std::move(bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  ByteReader(std::string_view bytes, const std::string& name) : left_(bytes), name_(name) {}

  template <typename Number>
  Number take() {
    Number number;
    std::memcpy(&number, take_raw(sizeof(Number)).data(), sizeof(Number));
    return number;
  }
  std::string take_text() { return std::string(take_raw(take<std::uint8_t>())); }
  std::string_view take_raw(std::size_t size) {
    if (size > left_.size()) refuse_summary(name_, "ends too early: it was cut off");
    const std::string_view raw = left_.substr(0, size);
    left_.remove_prefix(size);
    return raw;
  }
  std::size_t left() const { return left_.size(); }

 private:
  std::string_view left_;
  const std::string& name_;
};

}  // namespace geoloc::io
