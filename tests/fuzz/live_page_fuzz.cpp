// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_pages.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  geoloc::io::hostile::ask_for_pages(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
