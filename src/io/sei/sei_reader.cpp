// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/sei_reader.hpp"

#include <algorithm>
#include <string_view>

namespace geoloc::io {
namespace {

constexpr std::string_view kStartCode{"\0\0\1", 3};
constexpr std::size_t kLengthSize = 4, kHeaderSize = 2;
constexpr std::size_t kLongestUnit =
    64 * 1024;  // of supplemental information; longer ones tell nothing to us

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// The next unit, taken off the front of a byte stream.
std::string_view take_started(std::string_view& stream) {
  const std::size_t code = stream.find(kStartCode);
  stream.remove_prefix(code == std::string_view::npos ? stream.size() : code + kStartCode.size());
  const std::string_view unit = stream.substr(0, stream.find(kStartCode));
  stream.remove_prefix(unit.size());
  return unit;
}

/// The same where lengths are told. Empty, with nothing left, where one is wrong.
std::string_view take_counted(std::string_view& units) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < kLengthSize && units.size() >= kLengthSize; ++i)
    length = length << 8U | byte_at(units, i);
  units.remove_prefix(std::min(kLengthSize, units.size()));
  if (length > units.size()) length = 0, units = {};
  const std::string_view unit = units.substr(0, length);
  units.remove_prefix(length);
  return unit;
}

bool is_supplemental(std::string_view unit) {
  constexpr unsigned kPrefixSei = 39, kSuffixSei = 40;
  if (unit.size() <= kHeaderSize || unit.size() > kLongestUnit) return false;
  const unsigned type = byte_at(unit, 0) >> 1U & 63U;
  return type == kPrefixSei || type == kSuffixSei;
}

/// Without the 3 that follows each two zeros.
std::string unprotected(std::string_view unit) {
  std::string content;
  int zeros = 0;
  for (const char byte : unit) {
    const bool is_protection = zeros >= 2 && byte == 3;
    zeros = byte == 0 ? zeros + 1 : 0;
    if (!is_protection) content += byte;
  }
  return content;
}

/// A type or a size: bytes of 255, and the first other one.
std::optional<std::size_t> take_number(std::string_view& content) {
  std::size_t number = 0;
  while (!content.empty()) {
    const unsigned byte = byte_at(content, 0);
    content.remove_prefix(1);
    number += byte;
    if (byte != 255) return number;
  }
  return std::nullopt;
}

void read_messages(std::string_view content, std::string_view uuid, std::optional<std::string>& last) {
  constexpr std::size_t kUserDataUnregistered = 5;
  while (content.size() > 1) {  // the last byte is the unit's end
    const auto type = take_number(content);
    const auto size = take_number(content);
    if (!type || !size || *size > content.size()) return;
    const std::string_view message = content.substr(0, *size);
    content.remove_prefix(*size);
    if (*type == kUserDataUnregistered && message.substr(0, uuid.size()) == uuid)
      last = message.substr(uuid.size());
  }
}

}  // namespace

std::optional<std::string> unregistered_data_h265(const std::array<std::uint8_t, 16>& uuid, UnitPrefix prefix,
                                                  const std::uint8_t* picture, std::size_t size) {
  const std::string_view wanted(reinterpret_cast<const char*>(uuid.data()), uuid.size());
  std::string_view units(reinterpret_cast<const char*>(picture), size);
  std::optional<std::string> last;
  while (!units.empty()) {
    const std::string_view unit =
        prefix == UnitPrefix::kStartCode ? take_started(units) : take_counted(units);
    if (is_supplemental(unit)) read_messages(unprotected(unit.substr(kHeaderSize)), wanted, last);
  }
  return last;
}

}  // namespace geoloc::io
