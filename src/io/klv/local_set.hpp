// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace geoloc::io {

/// How MISB ST 0601 writes a quantity: an integer of so many bytes whose values, all but one for errors where
/// there is a sign, are spread evenly from `low` to `high`. With a sign, `low` is -`high`.
struct Mapping {
  double low;
  double high;
  std::size_t bytes;
  bool is_signed;
};

constexpr Mapping unsigned_map(double low, double high, std::size_t bytes) {
  return {low, high, bytes, false};
}
constexpr Mapping signed_map(double high, std::size_t bytes) {
  return {-high, high, bytes, true};
}

constexpr bool holds(const Mapping& mapping, double value) {
  return value >= mapping.low && value <= mapping.high;  // false for NaN
}

/// A local set of SMPTE ST 336 as MISB ST 0601 has it: tags and lengths of one byte, big-endian values.
class LocalSet {
 public:
  void add_integer(std::uint8_t tag, std::uint64_t value, std::size_t bytes);

  /// Left out where the mapping does not hold it: a reader takes what is not there as unknown.
  void add(std::uint8_t tag, double value, const Mapping& mapping);

  /// That the value is beyond what its mapping, with a sign, can tell.
  void add_out_of_range(std::uint8_t tag, const Mapping& mapping);

  /// The set under its key of 16 bytes, closed by its checksum.
  std::string finish(std::string_view key) const;

 private:
  std::string items_;
};

/// The sum over 16-bit words that closes a set (ST 0601, 6.3); of all bytes from the key to the length of the
/// checksum itself.
std::uint16_t checksum_of(std::string_view bytes);

}  // namespace geoloc::io
