// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/text.hpp"

#include <cstdint>

namespace geoloc::io {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;  // in bytes; for an invalid sequence, the bytes to skip
  bool is_valid = false;
};

/// The first character of a non-empty text (RFC 3629).
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[size] || code > 0x10FFFF || is_surrogate) return {};
  return {code, size, true};
}

bool is_left_out(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xFFFE || code == 0xFFFF;
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t max_characters) {
  std::string clean;
  std::size_t characters = 0;
  std::size_t size_before_last = 0;
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!character.is_valid || !is_left_out(character.code)) {
      if (characters == max_characters) return clean.substr(0, size_before_last) + std::string(kEllipsis);
      size_before_last = clean.size();
      clean += character.is_valid ? text.substr(0, character.size) : kReplacement;
      ++characters;
    }
    text.remove_prefix(character.size);
  }
  return clean;
}

std::string ascii_text(std::string_view text, std::size_t max_size) {
  std::string ascii;
  while (!text.empty() && ascii.size() < max_size) {
    const Character character = first_character(text);
    const bool is_printable = character.is_valid && character.code >= 0x20 && character.code < 0x7F;
    ascii += is_printable ? text.front() : '?';
    text.remove_prefix(character.size);
  }
  return ascii;
}

}  // namespace geoloc::io
