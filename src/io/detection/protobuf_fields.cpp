// SPDX-License-Identifier: Apache-2.0
#include "protobuf_fields.hpp"

namespace geoloc::io {
namespace {

enum WireType : std::uint64_t { kVarint = 0, kFixed64 = 1, kLengthDelimited = 2, kFixed32 = 5 };

}  // namespace

std::optional<ProtobufField> ProtobufReader::next() {
  if (rest_.empty() || is_malformed_) return std::nullopt;
  auto field = take_field();
  is_malformed_ = !field;
  return field;
}

std::optional<ProtobufField> ProtobufReader::take_field() {
  const auto tag = take_varint();
  if (!tag) return std::nullopt;
  ProtobufField field;
  field.number = *tag >> 3U;
  std::optional<std::uint64_t> integer;
  std::optional<std::string_view> bytes;
  switch (*tag & 7U) {
    case kVarint:
      integer = take_varint();
      break;
    case kLengthDelimited:
      if (const auto size = take_varint()) bytes = take_bytes(*size);
      break;
    case kFixed64:
      return take_bytes(8) ? std::optional{field} : std::nullopt;
    case kFixed32:
      return take_bytes(4) ? std::optional{field} : std::nullopt;
    default:
      return std::nullopt;
  }
  if (!integer && !bytes) return std::nullopt;
  field.is_integer = integer.has_value();
  field.is_bytes = bytes.has_value();
  field.integer = integer.value_or(0);
  field.bytes = bytes.value_or(std::string_view{});
  return field;
}

std::optional<std::uint64_t> ProtobufReader::take_varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

std::optional<std::string_view> ProtobufReader::take_bytes(std::uint64_t size) {
  if (size > rest_.size()) return std::nullopt;
  const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
  rest_.remove_prefix(taken.size());
  return taken;
}

}  // namespace geoloc::io
