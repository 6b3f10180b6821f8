// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/markup.hpp"

namespace geoloc::io {

std::string escape_markup(const std::string& text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(character) >= 0x20) result += character;
    }
  }
  return result;
}

}  // namespace geoloc::io
