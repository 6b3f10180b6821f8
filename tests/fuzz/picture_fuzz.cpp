// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "geoloc/io/picture/picture_file.hpp"

/// Any bytes as a JPEG. A complete one stays complete whatever follows it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view all{reinterpret_cast<const char*>(data), size};
  const std::string_view part = all.substr(0, size * data[size - 1] / 256);
  if (geoloc::io::is_whole_jpeg(part) && !geoloc::io::is_whole_jpeg(all)) std::abort();
  return 0;
}
