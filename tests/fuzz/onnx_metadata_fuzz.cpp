// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "geoloc/io/detection/onnx_metadata.hpp"

/// Any bytes as a model, and as the texts of its class names and its sigma.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto metadata = geoloc::io::read_onnx_metadata(data, size);
  if (metadata) {
    for (const auto& input : metadata->inputs) {
      for (const std::int64_t length : input.shape) {
        if (length <= 0 && length != geoloc::io::kUnknownLength) std::abort();
      }
    }
  }
  const auto names = geoloc::io::parse_class_names({reinterpret_cast<const char*>(data), size});
  if (names && names->empty()) std::abort();
  const auto sigma = geoloc::io::parse_centre_sigma({reinterpret_cast<const char*>(data), size});
  if (sigma && !(sigma->constant_px > 0 && sigma->of_size >= 0)) std::abort();
  return 0;
}
