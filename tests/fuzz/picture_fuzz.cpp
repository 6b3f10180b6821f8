// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geoloc/io/picture/picture_file.hpp"

/// Any bytes behind the start of a JPEG. One that ends with its last byte is not whole without it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::size_t whole = size;
  while (whole > 0 && geoloc::io::is_whole_jpeg({bytes.data(), whole})) --whole;
  if (whole < size && geoloc::io::is_whole_jpeg({bytes.data(), whole / 2})) std::abort();
  return 0;
}
