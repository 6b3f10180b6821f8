// SPDX-License-Identifier: Apache-2.0
#include "io/logs/dataflash.hpp"

#include <algorithm>
#include <array>

#include "io/logs/little_endian.hpp"
#include "io/logs/plain_numbers.hpp"

namespace geoloc::io {
namespace {

constexpr char kHead1 = '\xA3', kHead2 = '\x95';
constexpr std::size_t kHeadSize = 3;  // two bytes that mark a record, and its type
constexpr std::uint8_t kFmtType = 128;
constexpr std::size_t kFmtSize = kHeadSize + 1 + 1 + 4 + 16 + 64;

/// The plain number that a type of ArduPilot's is stored as, and what it is divided by; the type itself where
/// it is plain.
struct Storage {
  char plain;
  double divisor;
};

Storage storage_of(char type) {
  switch (type) {
    case 'M':  // flight mode
      return {'B', 1.0};
    case 'c':
      return {'h', 1e2};
    case 'C':
      return {'H', 1e2};
    case 'e':
      return {'i', 1e2};
    case 'E':
      return {'I', 1e2};
    case 'L':
      return {'i', 1e7};
    default:
      return {type, 1.0};
  }
}

/// 0 for an unknown type, which makes the whole format unusable.
std::size_t size_of(char type) {
  switch (type) {
    case 'g':  // half precision
      return 2;
    case 'n':
      return 4;
    case 'N':
      return 16;
    case 'Z':
    case 'a':
      return 64;
    default:
      return plain_size(storage_of(type).plain);
  }
}

std::optional<double> number_at(char type, const char* bytes) {
  const auto [plain, divisor] = storage_of(type);
  const auto number = plain_number(plain, bytes);
  if (!number) return std::nullopt;
  return *number / divisor;
}

/// Text of a fixed size that zeros fill up.
std::string_view text_in(const char* bytes, std::size_t size) {
  const std::string_view text(bytes, size);
  return text.substr(0, text.find('\0'));
}

/// nullopt where types, names and length contradict each other.
std::optional<DataflashFormat> format_in(const char* fmt) {
  DataflashFormat format;
  format.size = read_number<std::uint8_t>(fmt + 4);
  format.name = text_in(fmt + 5, 4);
  const std::string_view types = text_in(fmt + 9, 16);
  std::string_view names = text_in(fmt + 25, 64);
  std::size_t offset = kHeadSize;
  for (const char type : types) {
    const std::size_t size = size_of(type);
    if (size == 0) return std::nullopt;
    const std::size_t end = std::min(names.find(','), names.size());
    format.fields.push_back({std::string(names.substr(0, end)), type, offset});
    names.remove_prefix(std::min(end + 1, names.size()));
    offset += size;
  }
  if (offset != format.size) return std::nullopt;
  return format;
}

bool is_head(std::string_view bytes, std::size_t at) {
  return at + kHeadSize <= bytes.size() && bytes[at] == kHead1 && bytes[at + 1] == kHead2;
}

/// Whether a record of that size may begin there: another one follows, or the end.
bool fits(std::string_view bytes, std::size_t at, std::size_t size) {
  const std::size_t end = at + size;
  if (end > bytes.size()) return false;
  return end == bytes.size() || bytes[end] == kHead1;
}

}  // namespace

std::optional<double> DataflashRecord::number(std::string_view field) const {
  for (const DataflashField& known : format_.fields) {
    if (known.name == field) return number_at(known.type, bytes_ + known.offset);
  }
  return std::nullopt;
}

std::size_t for_each_dataflash_record(std::string_view bytes,
                                      const std::function<void(const DataflashRecord&)>& take) {
  std::array<std::optional<DataflashFormat>, 256> formats;
  std::size_t skipped = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::uint8_t type = is_head(bytes, at) ? static_cast<std::uint8_t>(bytes[at + 2]) : 0;
    const bool is_fmt = type == kFmtType && is_head(bytes, at);
    const auto& format = formats[type];
    const std::size_t size = is_fmt ? kFmtSize : format ? format->size : 0;
    if (!is_head(bytes, at) || size == 0 || !fits(bytes, at, size)) {
      ++at;
      ++skipped;
      continue;
    }
    const char* const record = bytes.data() + at;
    if (is_fmt) {
      formats[static_cast<std::uint8_t>(record[kHeadSize])] = format_in(record);
    } else {
      take({*format, record});
    }
    at += size;
  }
  return skipped;
}

}  // namespace geoloc::io
