// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "fuzz/hostile_messages.hpp"

/// What a broker sends, an address of one, and the ids that a service kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size);
  geoloc::io::hostile::open_any_message(content);
  geoloc::io::hostile::read_any_address(content);
  geoloc::io::hostile::read_any_ids(content);
  return 0;
}
