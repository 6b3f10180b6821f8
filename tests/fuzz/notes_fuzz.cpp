// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  geoloc::io::hostile::read_any_notes(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
