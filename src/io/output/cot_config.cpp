// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_config.hpp"

#include <algorithm>
#include <cctype>

#include "geoloc/geometry/problems.hpp"

namespace geoloc::io {
namespace {

/// Letters and digits in groups, as in a-f-G-U-C.
bool is_type(const std::string& text) {
  bool was_dash = true;
  for (const char character : text) {
    const bool is_dash = character == '-';
    if (is_dash ? was_dash : std::isalnum(static_cast<unsigned char>(character)) == 0) return false;
    was_dash = is_dash;
  }
  return !was_dash && text.find('-') != std::string::npos && text.size() <= 64;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 32 && std::all_of(text.begin(), text.end(), [](char character) {
    return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '-' || character == '_' ||
           character == '.';
  });
}

}  // namespace

std::vector<std::string> CotConfig::problems() const {
  Problems found;
  found.require(is_name(uid_prefix), "cot.uid_prefix must be 1-32 letters, digits, '-', '_' or '.'");
  found.require(is_type(type), "cot.type must be a CoT type, such as a-u-G");
  found.require(
      std::all_of(types.begin(), types.end(), [](const auto& entry) { return is_type(entry.second); }),
      "cot.types must name CoT types, such as a-u-G");
  found.require(period_s >= 0.5 && period_s <= 3600.0, "cot.period_s must lie in [0.5, 3600]");
  found.require(stale_s >= period_s && stale_s <= 86400.0, "cot.stale_s must lie in [cot.period_s, 86400]");
  found.require(error_probability >= 0.1 && error_probability <= 0.999,
                "cot.error_probability must lie in [0.1, 0.999]");
  found.require(sigma_height_m > 0.0 && sigma_height_m <= 1000.0, "cot.sigma_height_m must lie in (0, 1000]");
  found.require(multicast_ttl >= 0 && multicast_ttl <= 255, "cot.multicast_ttl must lie in [0, 255]");
  return found.take();
}

}  // namespace geoloc::io
