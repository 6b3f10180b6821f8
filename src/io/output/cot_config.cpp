// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_config.hpp"

#include <algorithm>
#include <cctype>

#include "io/output/cot_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {

bool is_cot_type(const std::string& text) {
  bool was_dash = true;
  for (const char character : text) {
    const bool is_dash = character == '-';
    if (is_dash ? was_dash : std::isalnum(static_cast<unsigned char>(character)) == 0) return false;
    was_dash = is_dash;
  }
  return !was_dash && text.find('-') != std::string::npos && text.size() <= 64;
}

bool is_uid_prefix(const std::string& text) {
  return !text.empty() && text.size() <= 32 && std::all_of(text.begin(), text.end(), [](char character) {
    return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '-' || character == '_' ||
           character == '.';
  });
}

std::vector<std::string> CotConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc::io
