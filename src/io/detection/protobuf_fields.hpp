// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace geoloc::io {

/// A field of a protobuf message in its wire format (protobuf.dev/programming-guides/encoding).
struct ProtobufField {
  std::uint64_t number = 0;
  std::uint64_t integer = 0;  ///< of a varint
  std::string_view bytes;     ///< of a text, a byte string or a nested message; else empty
  bool is_bytes = false;
  bool is_integer = false;
};

/// Reads a message field by field. No length in it is trusted.
class ProtobufReader {
 public:
  explicit ProtobufReader(std::string_view message) : rest_(message) {}

  /// nullopt at the end, or where the message is malformed.
  std::optional<ProtobufField> next();

  bool is_malformed() const { return is_malformed_; }

 private:
  std::optional<std::uint64_t> take_varint();
  std::optional<std::string_view> take_bytes(std::uint64_t size);
  std::optional<ProtobufField> take_field();

  std::string_view rest_;
  bool is_malformed_ = false;
};

}  // namespace geoloc::io
