// SPDX-License-Identifier: Apache-2.0
#include "settings/rules.hpp"

#include <charconv>

namespace geoloc {

std::string to_text(double value) {
  std::array<char, 32> digits{};
  for (const int precision : {15, 17}) {
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                       std::chars_format::general, precision);
    double back = 0.0;
    std::from_chars(digits.data(), written.ptr, back);
    if (back == value || precision == 17) return {digits.data(), written.ptr};
  }
  return {};
}

std::string to_text(const Range& range) {
  return (range.includes_low ? "[" : "(") + to_text(range.low) + ", " + to_text(range.high) +
         (range.includes_high ? "]" : ")");
}

}  // namespace geoloc
