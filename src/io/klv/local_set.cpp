// SPDX-License-Identifier: Apache-2.0
#include "local_set.hpp"

#include <cmath>

namespace geoloc::io {
namespace {

constexpr std::uint8_t kChecksum = 1;
constexpr std::size_t kChecksumBytes = 2;

std::string big_endian(std::uint64_t value, std::size_t bytes) {
  std::string text(bytes, '\0');
  for (std::size_t i = 0; i < bytes; ++i) text[bytes - 1 - i] = static_cast<char>(value >> (8 * i));
  return text;
}

std::string item_head(std::uint8_t tag, std::size_t bytes) {
  return {static_cast<char>(tag), static_cast<char>(bytes)};
}

/// BER: one byte up to 127, else the number of bytes that follow.
std::string length_of(std::size_t bytes) {
  if (bytes < 0x80) return big_endian(bytes, 1);
  if (bytes <= 0xff) return '\x81' + big_endian(bytes, 1);
  return '\x82' + big_endian(bytes, 2);
}

std::uint64_t largest_of(const Mapping& mapping) {
  const std::size_t bits = 8 * mapping.bytes - (mapping.is_signed ? 1 : 0);
  return (std::uint64_t{1} << bits) - 1;
}

}  // namespace

void LocalSet::add_integer(std::uint8_t tag, std::uint64_t value, std::size_t bytes) {
  items_ += item_head(tag, bytes) + big_endian(value, bytes);
}

void LocalSet::add(std::uint8_t tag, double value, const Mapping& mapping) {
  if (!holds(mapping, value)) return;
  const double zero = mapping.is_signed ? 0.0 : mapping.low;
  const double step = (mapping.high - zero) / static_cast<double>(largest_of(mapping));
  add_integer(tag, static_cast<std::uint64_t>(std::llround((value - zero) / step)), mapping.bytes);
}

void LocalSet::add_out_of_range(std::uint8_t tag, const Mapping& mapping) {
  add_integer(tag, std::uint64_t{1} << (8 * mapping.bytes - 1), mapping.bytes);
}

std::string LocalSet::finish(std::string_view key) const {
  const std::string head = item_head(kChecksum, kChecksumBytes);
  std::string set =
      std::string(key) + length_of(items_.size() + head.size() + kChecksumBytes) + items_ + head;
  return set + big_endian(checksum_of(set), kChecksumBytes);
}

std::uint16_t checksum_of(std::string_view bytes) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    sum += static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) << (i % 2 == 0 ? 8U : 0U);
  return static_cast<std::uint16_t>(sum);
}

}  // namespace geoloc::io
