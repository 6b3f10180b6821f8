// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "fuzz/hostile_video_telemetry.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  geoloc::io::hostile::read_any_telemetry({reinterpret_cast<const char*>(data), size});
  return 0;
}
