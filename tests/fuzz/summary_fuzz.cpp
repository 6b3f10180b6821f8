// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_summaries.hpp"

/// Bytes and JSON: as they are, and with a checksum that fits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size);
  geoloc::io::hostile::read_any_summary(content);
  geoloc::io::hostile::read_any_sealed_summary(content);
  return 0;
}
