// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>

#include "geoloc/io/detection/onnx_metadata.hpp"

namespace geoloc::io {
namespace {

/// The whole of the text as a number, in any locale.
std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<CentreSigma> parse_centre_sigma(std::string_view text) {
  const auto comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto constant_px = number(text.substr(0, comma)), of_size = number(text.substr(comma + 1));
  if (!constant_px || !of_size || !(*constant_px > 0.0) || !(*of_size >= 0.0)) return std::nullopt;
  return CentreSigma{*constant_px, *of_size};
}

}  // namespace geoloc::io
