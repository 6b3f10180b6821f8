// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

// Logs for tests, byte by byte.
namespace geoloc::io {

template <typename... Numbers>
std::string packed(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof(numbers)), ...);
  return bytes;
}

/// Text that zeros fill up.
inline std::string padded(std::string text, std::size_t size) {
  text.resize(size);
  return text;
}

}  // namespace geoloc::io
